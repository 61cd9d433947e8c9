#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "asperity/camera/camera_source.h"
#include "asperity/camera/open_image_folder.h"
#include "asperity/camera/open_v4l2.h"

namespace asperity {

inline constexpr std::array<std::string_view, 4> kCameraKindNames = {"v4l2", "y4m", "images", "video"};
enum class CameraKind { kV4l2, kY4m, kImages, kVideo };

// A camera as people name it:
//   v4l2:/dev/video0?size=640x480&rate=120&format=grey&exposure=2ms&gain=20&white_balance=4600&focus=0
//   y4m:PATH    a file or FIFO; y4m:- is standard input
//   images:FOLDER?rate=45
//   video:FILE
struct CameraAddress {
  CameraKind kind = CameraKind::kV4l2;
  std::string path;
  V4l2Config v4l2;
  ImageFolderConfig images;
};

// Options begin behind the last '?' and each may be given once. Throws Error naming the part that is wrong and what is
// possible there.
CameraAddress parse_camera_address(std::string_view text);

// Opens what the address names; throws as open_v4l2, open_y4m, open_image_folder and open_video do.
std::unique_ptr<CameraSource> open_camera(const CameraAddress& address);

}  // namespace asperity

#pragma once

#include <filesystem>
#include <memory>

#include "asperity/camera/camera_source.h"

namespace asperity {

// A video file (AVI, MP4/MOV, Matroska/WebM) through OpenCV and FFmpeg, in gray. t_ns is the container's time of each
// image from the first one on; an image whose time does not rise follows the one before by 1/rate. read() never waits.
//
// Other containers, playlists and addresses of the net are refused by the file's first bytes, so that a file cannot
// make FFmpeg open others. Throws Error if the file cannot be read or has no images of at most kLargestImageSide_px a
// side.
std::unique_ptr<CameraSource> open_video(const std::filesystem::path& path);

}  // namespace asperity

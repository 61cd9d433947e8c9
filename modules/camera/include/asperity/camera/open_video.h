#pragma once

#include <filesystem>
#include <memory>

#include "asperity/camera/camera_source.h"

namespace asperity {

// A video file (AVI, MP4/MOV, Matroska/WebM) in gray, decoded by the program `ffmpeg` (5.1 or newer, found by PATH),
// which runs until the source is closed. t_ns is the container's time of each image from the first one on; an image
// whose time does not rise follows the one before by 1/rate. read() waits for ffmpeg alone, at most a minute.
//
// Other containers, playlists and addresses of the net are refused by the file's first bytes, and ffmpeg is given no
// leave to open anything else. Throws Error if the file cannot be read, has no images of at most kLargestImageSide_px a
// side, or there is no ffmpeg.
std::unique_ptr<CameraSource> open_video(const std::filesystem::path& path);

}  // namespace asperity

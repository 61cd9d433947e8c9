#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "asperity/camera/camera_source.h"

namespace asperity {

struct ImageFolderConfig {
  double rate_Hz = 0.0;  // 0: the names are times, t_ns
};

// The PNG, JPEG and PGM images of a folder (not of those within) as frames. Without a rate every name is a whole
// number of nanoseconds, its t_ns, as in the frames/ of a recording, and orders the images; with one they are ordered
// by name, numbers in it by their value (img9 before img10), and t_ns is the index over the rate.
//
// read() never waits; one image that cannot be read throws Error naming it and is passed over by the next call.
// Opening throws Error if there is no such folder or no image in it, for more than a million files, and without a
// rate for names that are not times, for two of the same time, or for times that can't be: closer than 0.1 ms in the
// median.
std::unique_ptr<CameraSource> open_image_folder(const std::filesystem::path& folder,
                                                const ImageFolderConfig& config = {});

// The same for files of any name, in the given order if there is a rate.
std::unique_ptr<CameraSource> open_image_list(std::vector<std::filesystem::path> files,
                                              const ImageFolderConfig& config);

}  // namespace asperity

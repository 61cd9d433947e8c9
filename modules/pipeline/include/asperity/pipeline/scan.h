#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "asperity/pipeline/read_path.h"
#include "asperity/recording/recording.h"
#include "asperity/texture/texture.h"

namespace asperity {

// What is to be registered: a recording, or a path alone. All scans of a call share one world frame.
struct Scan {
  std::string name;
  std::optional<Recording> recording;
  PathFile path;                   // used if there is no recording
  std::optional<Texture> texture;  // laid along the path instead of the scan's own
  std::optional<int> placement{};  // scans with the same number lay in the same placement of the object; all or none
  std::string checksum{};          // of its files; empty: not known
};

// The tip's offset; zero for a path alone, whose probe is unknown.
inline Eigen::Vector3d tip_in_marker_m(const Scan& scan) {
  return scan.recording ? scan.recording->calibration.tip_in_marker_m : Eigen::Vector3d::Zero();
}

}  // namespace asperity

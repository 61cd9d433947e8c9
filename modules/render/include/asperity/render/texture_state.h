#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/texture/series_state.h"

namespace asperity {

// What a tip remembers of the texture that it touches, from one step to the next.
struct TextureState {
  SeriesState series;
  std::uint64_t texture_id = 0;  // RenderTexture::id of the step before; 0: none
  Eigen::Vector3d last_force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d fading_N = Eigen::Vector3d::Zero();  // what a change left over
  double fading_s = 0.0;                               // time since that change
};

}  // namespace asperity

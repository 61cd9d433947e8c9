#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/texture/series_state.h"

namespace asperity {

// What a tip remembers of the texture that it touches, from one step to the next. Plain data; begin with
// TextureState{}.
struct TextureState {
  SeriesState series;
  std::uint64_t series_id = 0;   // RenderTexture::id that the series belongs to; 0: none yet
  std::uint64_t texture_id = 0;  // RenderTexture::id of the step before; 0: none
  bool on_surface = false;       // at the step before, textured or not
  bool loaded = false;           // the geometric surface bore force at the step before
  bool fading = false;
  Eigen::Vector3d last_force_N = Eigen::Vector3d::Zero();
  Eigen::Vector3d fading_N = Eigen::Vector3d::Zero();  // what a change left over
  double fading_s = 0.0;                               // time since that change
  double cross_fade_s = 0.0;                           // of the last texture: after that nothing is left
};

}  // namespace asperity

#pragma once

namespace asperity {

inline constexpr double kSkin = 0x1p-24;  // thickness of the proxy's skin in extents of the model

// The proxy as a ball, and how finely it is placed.
struct ProxyBall {
  double radius_m = 0.0;  // of the tip and its skin
  double slack_m = 0.0;   // rounding: distances that differ by less are equal
  double coarse_m = 0.0;  // a length to begin with when it is unknown how far to look for triangles
  double stride_m = 0.0;  // how far the hand went in this step
  double skin_m = 0.0;
};

}  // namespace asperity

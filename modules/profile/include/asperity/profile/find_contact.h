#pragma once

#include <vector>

#include "asperity/base/config.h"
#include "asperity/geometry/motion.h"

namespace asperity {

struct ContactConfig {
  double touch_N = 0.15;
  double release_N = 0.05;
  double smoothing_s = 0.005;
  double max_flight_s = 0.02;
  double margin_s = 0.02;

  template <class V>
  void visit(V& v) {
    v.field("touch_N", touch_N, "force from which the tip counts as touching", {0.0, 1e3});
    v.field("release_N", release_N, "force below which it counts as lifted again", {-1e3, 1e3});
    v.field("smoothing_s", smoothing_s, "the force is averaged over this time before it is compared", {0.0, 1.0});
    v.field("max_flight_s", max_flight_s, "a loss of contact shorter than this is part of the profile", {0.0, 10.0});
    v.field("margin_s", margin_s, "left out on either side of a longer one: the tip leaves before the reading falls",
            {0.0, 10.0});
  }
};

// For each sample whether the tip touches the surface (char, because vector<bool> has no data()): the
// force, interpolated between its own samples, against two thresholds (hysteresis). A flight shorter
// than max_flight_s stays in: the tip's height is known in it as well as elsewhere. A longer one takes margin_s on
// either side with it. All true if the
// motion has no force. Throws Error if release_N exceeds touch_N.
std::vector<char> find_contact(const TipMotion& motion, const ContactConfig& config);

}  // namespace asperity

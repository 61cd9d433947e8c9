#pragma once

#include <map>
#include <optional>
#include <string>

#include "asperity/base/problem.h"
#include "asperity/geometry/motion.h"
#include "asperity/trajectory/object_motion.h"

namespace asperity {

// What a trajectory method estimates, with its diagnostics.
struct TrajectoryResult {
  TipMotion motion;
  std::optional<ObjectMotion> object;     // `motion` is relative to it: its `world` is the object's frame
  std::map<std::string, double> metrics;  // named measurements of the run, units in the names
  Problems problems;                      // what was dropped or down-weighted, and why
  bool trustworthy = true;
  std::string verdict;  // in words, if not trustworthy
};

}  // namespace asperity

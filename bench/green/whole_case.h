#pragma once

#include "asperity/pipeline/scan_points.h"
#include "cases.h"

namespace bench {

// A case from a simulated recording (open probe, full noise, imperfect calibration, sandpaper) instead of points with
// errors laid on: its path through five points of a line over a pebble, 60 to 160 mm. Near guess, no guess and wrong
// mesh in turn.
struct WholeCase {
  RegistrationCase as;  // its `errors` are those that the trajectory states; `paths` as measured
  asperity::ScanPoints scans;
};

WholeCase simulate_case(const BodyPool& pool, std::uint64_t seed, std::uint64_t number);

}  // namespace bench

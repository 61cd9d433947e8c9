#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/registration/registration_result.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// One position of the object in the world frame: between the scans of a placement it did not move.
struct Placement {
  RegistrationResult registration;  // of all its scans
  std::vector<std::size_t> scans;   // indices of the scans, rising
  Verdicts verdicts;                // of its pose, the worst first
};

// Which scans share a placement where the scans themselves do not state it (Scan::placement).
enum class PlacementMode { kAuto, kSame, kEach };
inline constexpr std::array<std::string_view, 3> kPlacementModeNames{"auto", "same", "each"};

struct PlacementConfig {
  PlacementMode mode = PlacementMode::kAuto;

  template <class V>
  void visit(V& v) {
    v.choice("mode", mode, kPlacementModeNames,
             "which scans share a placement of the object: found by their likelihood (auto), all, none");
  }
};

// Groups of scans that share a placement, in the order of their first scans. `stated` has one number a scan: equal
// numbers are one placement.
std::vector<std::vector<std::size_t>> group_placements(const std::vector<std::size_t>& stated);

}  // namespace asperity

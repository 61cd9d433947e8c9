#pragma once

#include "asperity/import/check_streams.h"

namespace asperity {

// The part of check_streams on rotations.
void check_rotation(const ImportStreams& streams, const StreamUnits& units, StreamChecks& out);

// The unit by which a value read in `unit` would be `ratio` times smaller, within `tolerance` (a factor); "" if none.
std::string unit_for_ratio(const std::string& unit, Quantity quantity, double ratio, double tolerance);

}  // namespace asperity

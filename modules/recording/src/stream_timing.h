#pragma once

#include <cstdint>
#include <vector>

#include "asperity/recording/inspection.h"

namespace asperity {

// `t_ns` rises strictly and is not empty.
StreamTiming stream_timing(const std::vector<std::int64_t>& t_ns);

}  // namespace asperity

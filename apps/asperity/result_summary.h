#pragma once

#include <string>

#include "asperity/pipeline/process_result.h"

namespace asperity::app {

// A few lines for a person on what was measured.
std::string result_summary(const ProcessResult& result);

}  // namespace asperity::app

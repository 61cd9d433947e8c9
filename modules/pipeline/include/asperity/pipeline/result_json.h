#pragma once

#include <string>

#include "asperity/json/json.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// What result.json says: everything measured, what was dropped and why, the settings, the version. `name` is the
// recording's. nan is null. The same result gives the same bytes.
Json result_json(const ProcessResult& result, const Recording& recording, const std::string& name);

// The bytes of result.json.
std::string result_text(const Json& json);

}  // namespace asperity

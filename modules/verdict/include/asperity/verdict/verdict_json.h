#pragma once

#include "asperity/json/json.h"
#include "asperity/verdict/verdict.h"

namespace asperity {

// [{"code","severity","message","remedy"}], the key `verdicts` of result.json and --json.
Json verdicts_json(const Verdicts& verdicts);

}  // namespace asperity

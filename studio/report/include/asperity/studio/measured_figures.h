#pragma once

#include "asperity/pipeline/process_result.h"
#include "asperity/studio/block.h"

namespace asperity::studio {

// The figures of result.json for a person: [{"group","key","label","value","error","unit"}] in the order in which they
// are shown. `key` is the figure's place in result.json, `value` a number in `unit`, a text, or null where the data did
// not allow one; `error` its standard error, where it is known; "count" is true for whole numbers.
Json measured_figures(const ProcessResult& result);

}  // namespace asperity::studio

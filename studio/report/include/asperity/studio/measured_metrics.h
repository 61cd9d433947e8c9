#pragma once

#include "asperity/studio/block.h"

namespace asperity::studio {

// The metrics of a result.json for a person, the only place that names them, their units and factors:
// [{"group","key","label","value","error","unit","hint"}] in the order in which they are shown. `key` is the metric's
// place in result.json, `value` a number in `unit`, a text, or null where the data did not allow one; `error` its
// standard error, where it is known; "count" is true for whole numbers. Left out is what the result does not have, and
// what means nothing for it: the pitch of a surface that is not periodic.
Json measured_metrics(const Json& result);

}  // namespace asperity::studio

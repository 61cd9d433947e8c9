#pragma once

#include <string>
#include <vector>

#include "asperity/json/json.h"
#include "asperity/profile/heights_units.h"
#include "asperity/session/texture_input.h"

namespace asperity::app {

// {"height": {"unit", "m", "origin"}, "position": the same, or null}: as units_text() has them.
Json units_json(const HeightsUnits& units);

// Of several files: an array of them, each with its `file`; and as lines of text, one if all have the same units.
Json units_json(const std::vector<FileUnits>& files);
std::string units_lines(const std::vector<FileUnits>& files);

}  // namespace asperity::app

#include "units_json.h"

#include <algorithm>

#include "asperity/base/text.h"

namespace asperity::app {

namespace {

Json one_unit(const ReadUnit& unit) {
  if (!(unit.metres > 0.0)) return nullptr;
  return {{"unit", length_unit_name(unit.metres)}, {"m", unit.metres}, {"origin", unit_origin_name(unit.origin)}};
}

}  // namespace

Json units_json(const HeightsUnits& units) {
  return {{"height", one_unit(units.height)}, {"position", one_unit(units.position)}};
}

Json units_json(const std::vector<FileUnits>& files) {
  Json out = Json::array();
  for (const FileUnits& one : files) {
    Json of = units_json(one.units);
    of["file"] = one.file;
    out.push_back(of);
  }
  return out;
}

std::string units_lines(const std::vector<FileUnits>& files) {
  if (files.empty()) return {};
  const std::string first = units_text(files.front().units);
  const bool same =
      std::all_of(files.begin(), files.end(), [&](const FileUnits& one) { return units_text(one.units) == first; });
  if (same) return first + "\n";
  std::string out;
  for (const FileUnits& one : files) out += printable(one.file, 200) + ": " + units_text(one.units) + "\n";
  return out;
}

}  // namespace asperity::app

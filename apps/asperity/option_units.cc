#include "option_units.h"

#include <string_view>

#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "command.h"

namespace asperity::app {

namespace {

template <class Parse>
double parsed(Parse parse, std::string_view option, std::string_view text) {
  try {
    return parse(text, option);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

double length_option_m(const std::string& option, const std::string& text) {
  return parsed(parse_length_m, option, text);
}

double unit_option_m(const std::string& option, const std::string& text) {
  const bool a_name = !text.empty() && text.find_first_of("0123456789+-.") == std::string::npos;
  const double unit_m = length_option_m(option, a_name ? "1" + text : text);
  constexpr double kLeast_m = 1e-9, kMost_m = 1e3;
  if (!(unit_m >= kLeast_m && unit_m <= kMost_m)) {
    throw UsageError(option + ": '" + printable(text) + "' is not between 1 nm and 1000 m");
  }
  return unit_m;
}

double speed_option_mps(const std::string& option, const std::string& text) {
  const double speed_mps = parsed(parse_speed_mps, option, text);
  constexpr double kFastest_mps = 10.0;  // no hand strokes faster
  if (!(speed_mps > 0.0 && speed_mps <= kFastest_mps)) {
    throw UsageError(option + ": '" + printable(text) + "' is not between 0 and 10 m/s");
  }
  return speed_mps;
}

std::array<double, 3> lengths_option_m(const std::string& option, const std::string& text) {
  std::array<double, 3> out{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == out.size())) {
      throw UsageError(option + ": '" + printable(text) + "' is not three lengths, such as 0.15mm,0.13mm,0.54mm");
    }
    out[i] = length_option_m(option, std::string(rest.substr(0, comma)));
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  return out;
}

}  // namespace asperity::app

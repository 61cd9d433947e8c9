#include "option_units.h"

#include <cmath>
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

Pose pose_option(const std::string& option, const std::string& text) {
  std::array<double, 7> v{};
  std::string_view rest = text;
  const auto fail = [&] {
    throw UsageError(option + ": '" + printable(text, 200) + "' is not a pose, such as 0.1,0,0.3,1,0,0,0");
  };
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto comma = rest.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == v.size())) fail();
    const auto number = parse_double(rest.substr(0, comma));
    if (!number || !std::isfinite(*number)) fail();
    v[i] = *number;
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  constexpr double kNormTolerance = 0.01;  // of a quaternion typed with a few digits
  if (!(std::abs(q.norm() - 1.0) < kNormTolerance)) {
    throw UsageError(option + ": '" + printable(text, 200) + "' has a quaternion that is not of unit length");
  }
  return {q.normalized(), {v[0], v[1], v[2]}};
}

}  // namespace asperity::app

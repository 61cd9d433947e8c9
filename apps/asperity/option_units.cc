#include "option_units.h"

#include <cmath>
#include <optional>
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
  return parsed(parse_length_unit_m, option, text);
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

namespace {

// Exactly N finite numbers with commas between; nothing if the text is not that.
template <std::size_t N>
std::optional<std::array<double, N>> numbers(std::string_view text) {
  std::array<double, N> out{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto comma = text.find(',');
    const auto number = parse_double(text.substr(0, comma));
    const bool last = i + 1 == N;
    if (!number || !std::isfinite(*number) || (comma == std::string_view::npos) != last) return std::nullopt;
    out[i] = *number;
    if (!last) text.remove_prefix(comma + 1);
  }
  return out;
}

Eigen::Vector3d point_m(const std::string& option, std::string_view text, double unit_m) {
  const auto p = numbers<3>(text);
  if (!p) throw UsageError(option + ": '" + printable(trim(text)) + "' is not a point x,y,z");
  return unit_m * Eigen::Vector3d((*p)[0], (*p)[1], (*p)[2]);
}

// Calls visit for what stands between the semicolons; one at the end is allowed.
template <class Visit>
void for_each_entry(std::string_view text, Visit visit) {
  while (!trim(text).empty()) {
    const auto end = text.find(';');
    visit(trim(text.substr(0, end)));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
}

}  // namespace

double duration_option_s(const std::string& option, const std::string& text, double longest_s) {
  const double duration_s = parsed(parse_duration_s, option, text);
  if (!(duration_s > 0.0 && duration_s <= longest_s)) {
    throw UsageError(option + ": '" + printable(text) + "' is not between 0 and " + number_text(longest_s) + " s");
  }
  return duration_s;
}

double number_option(const std::string& option, const std::string& text, const std::string& unit, double low,
                     double high) {
  std::string_view digits = trim(text);
  if (digits.ends_with(unit)) digits.remove_suffix(unit.size());
  const auto number = parse_double(digits);
  if (!number || !(*number >= low && *number <= high)) {
    throw UsageError(option + ": '" + printable(text) + "' is not a number" + (unit.empty() ? "" : " of " + unit) +
                     " from " + number_text(low) + " to " + number_text(high));
  }
  return *number;
}

std::vector<int> counts_option(const std::string& option, const std::string& text) {
  std::vector<int> out;
  std::string_view rest = text;
  for (bool more = true; more;) {
    const auto comma = rest.find(',');
    const auto number = parse_double(trim(rest.substr(0, comma)));
    if (!number || !(*number >= 1.0 && *number <= 1e6) || *number != std::floor(*number)) {
      throw UsageError(option + ": '" + printable(text, 200) +
                       "' is not a list of whole numbers from 1, such as 1,1,2");
    }
    out.push_back(static_cast<int>(*number));
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  return out;
}

double force_option_N(const std::string& option, const std::string& text, double most_N) {
  if (!trim(text).ends_with('N')) throw UsageError(option + ": '" + printable(text) + "' is not a force such as 1N");
  return number_option(option, text, "N", 0.0, most_N);
}

Eigen::Vector3d point_option_m(const std::string& option, const std::string& text) {
  if (const auto p = numbers<3>(text)) return {(*p)[0], (*p)[1], (*p)[2]};
  const std::array<double, 3> p = lengths_option_m(option, text);
  return {p[0], p[1], p[2]};
}

std::vector<Eigen::Vector3d> points_option_m(const std::string& option, const std::string& text, double unit_m) {
  std::vector<Eigen::Vector3d> out;
  for_each_entry(text, [&](std::string_view entry) { out.push_back(point_m(option, entry, unit_m)); });
  return out;
}

PickedPairs pairs_option(const std::string& option, const std::string& text, double unit_m) {
  PickedPairs out;
  for_each_entry(text, [&](std::string_view entry) {
    const auto equals = entry.find('=');
    if (equals == std::string_view::npos)
      throw UsageError(option + ": '" + printable(entry) + "' is not a pair x,y,z=x,y,z");
    out.p_world_m.push_back(point_m(option, entry.substr(0, equals), 1.0));
    out.p_mesh_m.push_back(point_m(option, entry.substr(equals + 1), unit_m));
  });
  return out;
}

ManualAlignment alignment_option(const std::string& option, const std::string& text) {
  const auto v = numbers<6>(text);
  if (!v) {
    throw UsageError(option + ": '" + printable(text, 200) + "' is not x,y,z,rx,ry,rz, such as 0.1,0,0.3,90,0,0");
  }
  return {{(*v)[0], (*v)[1], (*v)[2]}, {(*v)[3], (*v)[4], (*v)[5]}};
}

Pose pose_option(const std::string& option, const std::string& text) {
  const auto seven = numbers<7>(text);
  if (!seven) throw UsageError(option + ": '" + printable(text, 200) + "' is not a pose, such as 0.1,0,0.3,1,0,0,0");
  const auto& v = *seven;
  const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
  constexpr double kNormTolerance = 0.01;  // of a quaternion typed with a few digits
  if (!(std::abs(q.norm() - 1.0) < kNormTolerance)) {
    throw UsageError(option + ": '" + printable(text, 200) + "' has a quaternion that is not of unit length");
  }
  return {q.normalized(), {v[0], v[1], v[2]}};
}

}  // namespace asperity::app

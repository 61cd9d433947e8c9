#include "asperity/tracking/pose_lines.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kLongestLine_bytes = 1000;
constexpr double kQuaternionTolerance = 1e-3;  // as read_recording's
constexpr double kFarthest_m = 1e4;
constexpr int kMostMarkersOfPose = 1000;

std::string_view next_cell(std::string_view& rest) {
  const std::size_t comma = rest.find(',');
  const std::string_view cell = trim(rest.substr(0, comma));
  rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
  return cell;
}

std::optional<TrackerSample> parse_line(std::string_view line, std::int64_t arrival_ns) {
  TrackerSample out;
  const std::string_view time = next_cell(line);
  const auto t_ns = time.empty() ? std::optional(arrival_ns) : parse_int64(time);
  if (!t_ns || *t_ns < 0 || *t_ns > (std::int64_t{1} << 62)) return std::nullopt;
  out.t_ns = *t_ns;
  std::array<double, 7> values{};
  for (double& value : values) {
    const auto number = parse_double(next_cell(line));
    if (!number || !std::isfinite(*number)) return std::nullopt;
    value = *number;
  }
  out.T_world_marker.translation_m = {values[0], values[1], values[2]};
  const Eigen::Quaterniond q(values[3], values[4], values[5], values[6]);
  if (out.T_world_marker.translation_m.cwiseAbs().maxCoeff() > kFarthest_m) return std::nullopt;
  if (!(std::abs(q.norm() - 1.0) <= kQuaternionTolerance)) return std::nullopt;
  out.T_world_marker.rotation = q.normalized();
  if (const auto markers = parse_int64(next_cell(line)); markers && *markers >= 0 && *markers <= kMostMarkersOfPose)
    out.markers = static_cast<int>(*markers);
  if (const auto px = parse_double(next_cell(line)); px && std::isfinite(*px) && *px >= 0.0) out.reprojection_px = *px;
  return out;
}

}  // namespace

void PoseLines::push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<TrackerSample>& out) {
  for (const std::uint8_t byte : bytes) {
    if (byte == '\n') {
      take_line(arrival_ns, out);
    } else if (line_.size() < kLongestLine_bytes) {
      line_ += static_cast<char>(byte);
    } else {
      too_long_ = true;
    }
  }
}

std::size_t PoseLines::take_body(std::string_view& line) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!line.starts_with(bodies_[i]) || line.substr(bodies_[i].size(), 1) != ",") continue;
    line.remove_prefix(bodies_[i].size() + 1);
    return i + 1;
  }
  return 0;
}

void PoseLines::take_line(std::int64_t arrival_ns, std::vector<TrackerSample>& out) {
  std::string_view line = trim(line_);
  const std::size_t body = take_body(line);
  if (too_long_) {
    ++bad_lines_;
  } else if (!line.empty() && !line.starts_with('#') && !line.starts_with("t_ns")) {
    if (const auto pose = parse_line(line, arrival_ns)) {
      out.push_back(*pose);
      out.back().body = body;
    } else {
      ++bad_lines_;
    }
  }
  line_.clear();
  too_long_ = false;
}

}  // namespace asperity

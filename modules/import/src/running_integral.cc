#include "running_integral.h"

#include <algorithm>

namespace asperity {

namespace {
double seconds_between(std::int64_t from_ns, std::int64_t to_ns) { return static_cast<double>(to_ns - from_ns) * 1e-9; }
}  // namespace

RunningIntegral::RunningIntegral(const std::vector<std::int64_t>& t_ns, const std::vector<Eigen::Vector3d>& value)
    : t_ns_(t_ns), value_(value), sum_(t_ns.size(), Eigen::Vector3d::Zero()) {
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    sum_[i] = sum_[i - 1] + 0.5 * seconds_between(t_ns[i - 1], t_ns[i]) * (value[i - 1] + value[i]);
  }
}

std::optional<Eigen::Vector3d> RunningIntegral::to(std::int64_t t_ns) const {
  if (t_ns_.empty() || t_ns < t_ns_.front() || t_ns > t_ns_.back()) return std::nullopt;
  const auto behind = std::upper_bound(t_ns_.begin(), t_ns_.end(), t_ns) - t_ns_.begin();
  const std::size_t row = static_cast<std::size_t>(behind) - 1;
  if (row + 1 == t_ns_.size()) return sum_[row];
  const double step_s = seconds_between(t_ns_[row], t_ns_[row + 1]), into_s = seconds_between(t_ns_[row], t_ns);
  const Eigen::Vector3d slope = (value_[row + 1] - value_[row]) / step_s;
  return Eigen::Vector3d(sum_[row] + into_s * value_[row] + 0.5 * into_s * into_s * slope);
}

std::optional<Eigen::Vector3d> RunningIntegral::between(std::int64_t from_ns, std::int64_t to_ns) const {
  const auto from = to(from_ns), until = to(to_ns);
  if (!from || !until) return std::nullopt;
  return Eigen::Vector3d(*until - *from);
}

}  // namespace asperity

#include "asperity/fidelity/device_path.h"

#include <algorithm>

#include "asperity/base/error.h"

namespace asperity {

TimeIndex find_time(const std::vector<std::int64_t>& times_ns, std::int64_t t_ns, std::size_t& hint) {
  if (times_ns.empty()) throw Error("path: it has no points");
  if (hint >= times_ns.size() || times_ns[hint] > t_ns) {
    const auto after = std::upper_bound(times_ns.begin(), times_ns.end(), t_ns);
    hint = after == times_ns.begin() ? 0 : static_cast<std::size_t>(after - times_ns.begin()) - 1;
  }
  while (hint + 1 < times_ns.size() && times_ns[hint + 1] <= t_ns) ++hint;
  if (hint + 1 == times_ns.size() || t_ns <= times_ns[hint]) return {hint, 0.0};
  return {hint, static_cast<double>(t_ns - times_ns[hint]) / static_cast<double>(times_ns[hint + 1] - times_ns[hint])};
}

Eigen::Vector3d position_at(const DevicePath& path, std::int64_t t_ns, std::size_t& hint) {
  const TimeIndex place = find_time(path.t_ns, t_ns, hint);
  if (place.share == 0.0) return path.p_world_m[place.index];
  const Eigen::Vector3d& from_m = path.p_world_m[place.index];
  return from_m + place.share * (path.p_world_m[place.index + 1] - from_m);
}

}  // namespace asperity

#include "coverage_notes.h"

#include <algorithm>

#include <fmt/format.h>
#include "asperity/base/error.h"

namespace asperity {

namespace {

struct Stretch {
  double from_s = 0.0, to_s = 0.0;

  double length_s() const { return to_s - from_s; }
};

Stretch stretch_of(const std::vector<std::int64_t>& t_ns, std::int64_t zero_ns) {
  return {1e-9 * static_cast<double>(t_ns.front() - zero_ns), 1e-9 * static_cast<double>(t_ns.back() - zero_ns)};
}

Stretch common_of(const Stretch& a, const Stretch& b) {
  return {std::max(a.from_s, b.from_s), std::min(a.to_s, b.to_s)};
}

bool is_much_shorter(const Stretch& common, const Stretch& all) {
  constexpr double kLeast_s = 0.1, kShare = 0.01;
  return all.length_s() - common.length_s() > std::max(kLeast_s, kShare * all.length_s());
}

}  // namespace

std::vector<std::string> coverage_notes(const ImportTables& tables, const ImportStreams& streams) {
  std::vector<std::string> out;
  if (streams.pose.size() == 0 || streams.specific_force.size() == 0) return out;
  const std::int64_t zero_ns = streams.specific_force.t_ns.front();
  const Stretch pose = stretch_of(streams.pose.t_ns, zero_ns), imu = stretch_of(streams.specific_force.t_ns, zero_ns);
  const Stretch common = common_of(pose, imu);
  if (!(common.length_s() > 0.0)) return out;  // refused or aligned elsewhere
  if (is_much_shorter(common, pose) || is_much_shorter(common, imu)) {
    out.push_back(
        fmt::format("times: poses and inertial sensor have {:.2f} s in common, of {:.2f} s of poses and {:.2f} "
                    "s of the sensor",
                    common.length_s(), pose.length_s(), imu.length_s()));
  }
  const auto& force_ns = streams.force.size() > 0 ? streams.force.t_ns : streams.force3.t_ns;
  if (force_ns.empty() || !tables.force) return out;
  const Stretch force = stretch_of(force_ns, zero_ns), used = common_of(common, force);
  const std::string& file = tables.force->table.file;
  if (!(used.length_s() > 0.0)) {
    throw Error(
        fmt::format("{}: the force is at {:.6g} s to {:.6g} s of the inertial sensor's time, the poses and the "
                    "sensor are at {:.6g} s to {:.6g} s: their times do not overlap; state the unit of its time, "
                    "as t=NAME[ms], or its rate in place of the times",
                    file, force.from_s, force.to_s, common.from_s, common.to_s));
  }
  if (is_much_shorter(used, common)) {
    out.push_back(fmt::format("force: {} covers {:.2f} s of the {:.2f} s that poses and inertial sensor have in common",
                              file, used.length_s(), common.length_s()));
  }
  return out;
}

}  // namespace asperity

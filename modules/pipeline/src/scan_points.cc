#include "asperity/pipeline/scan_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_methods.h"
#include "asperity/pipeline/process_motion.h"
#include "asperity/profile/find_contact.h"

namespace asperity {

namespace {

// A path without times is given some: evenly, at a usual speed of the hand. Only its sequence counts.
void spread_times(TipMotion& motion) {
  constexpr double kUsual_mps = 0.025;
  constexpr std::size_t kChords = 200;  // few enough for noise not to lengthen them much
  const std::size_t n = motion.size(), step = std::max<std::size_t>(1, n / kChords);
  double length_m = 0.0;
  for (std::size_t i = step; i < n; i += step) {
    length_m += (motion.p_world_tip_m[i] - motion.p_world_tip_m[i - step]).norm();
  }
  constexpr double kLongest_ns = 1e18;  // 30 years: what a length in other units than metres makes of it
  const double step_ns = std::max(1.0, std::min(length_m / kUsual_mps * 1e9, kLongest_ns) / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) motion.t_ns[i] = static_cast<std::int64_t>(static_cast<double>(i) * step_ns);
}

ProcessResult motion_of(const Scan& scan, const RegisterConfig& config, const Observer& observer) {
  if (scan.recording) {
    const ProcessMethod& method = ProcessMethods::get(config.process.method);
    if (!method.prepare_registration) return estimate_motion(*scan.recording, config.process, observer);
    return estimate_motion(method.prepare_registration(config.process, *scan.recording), config.process, observer);
  }
  ProcessResult out;
  out.trajectory.motion = scan.path.motion;
  out.problems = scan.path.problems;
  if (!scan.path.timed) spread_times(out.trajectory.motion);
  return out;
}

// Whether points without times follow one another all the same, as those of a path do: the points of a cloud are listed
// in steps as long as the cloud.
bool is_path(const std::vector<Eigen::Vector3d>& p_m) {
  constexpr std::size_t kLeast = 30;
  constexpr double kShort = 0.2;
  if (p_m.size() < kLeast) return false;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : p_m) mean_m += p / static_cast<double>(p_m.size());
  double square_m2 = 0.0;
  std::vector<double> steps_m;
  for (std::size_t i = 0; i < p_m.size(); ++i) {
    square_m2 += (p_m[i] - mean_m).squaredNorm() / static_cast<double>(p_m.size());
    if (i > 0) steps_m.push_back((p_m[i] - p_m[i - 1]).norm());
  }
  const auto half = steps_m.begin() + static_cast<std::ptrdiff_t>(steps_m.size() / 2);
  std::nth_element(steps_m.begin(), half, steps_m.end());
  return *half < kShort * std::sqrt(square_m2);
}

bool is_in_sequence(const Scan& scan) {
  return scan.recording || scan.path.timed || is_path(scan.path.motion.p_world_tip_m);
}

PathPoints points_of(const Scan& scan, const TipMotion& motion, const RegisterConfig& config) {
  // Points without times stand for themselves: nothing rests in them.
  if (!scan.recording && !scan.path.timed) {
    PathPoints out = measured_path(motion, {}, Eigen::Vector3d::Zero(), config.points);  // for their errors
    out.path.p_world_m = motion.p_world_tip_m;
    out.path.q_world_marker.clear();
    out.sample.clear();
    for (std::size_t i = 0; i < motion.size(); ++i) out.sample.push_back(static_cast<double>(i));
    return out;
  }
  return measured_path(motion, find_contact(motion, config.process.base.contact), tip_in_marker_m(scan), config.points);
}

// Scans with the same calibrated tip are of one session: its error is theirs in common. The first scan's index is the
// number.
void number_tips(const std::vector<Scan>& scans, ScanPoints& out) {
  const auto same_tip = [](const Scan& a, const Scan& b) {
    if (!a.recording || !b.recording) return false;
    const Calibration& x = a.recording->calibration;
    const Calibration& y = b.recording->calibration;
    return x.tip_in_marker_m == y.tip_in_marker_m && x.tip_sigma_m == y.tip_sigma_m;
  };
  for (std::size_t i = 0; i < scans.size(); ++i) {
    std::size_t first = 0;
    while (first < i && !same_tip(scans[first], scans[i])) ++first;
    out.points[i].path.tip = static_cast<int>(first);
  }
}

// A path may be the trajectory of a recording that is there too.
void check_trajectories(const std::vector<Scan>& scans, const ScanPoints& points) {
  std::vector<NamedFingerprint> named;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Fingerprint of;
    of.points = sketch_points(points.motions[i].trajectory.motion.p_world_tip_m);
    named.push_back({scans[i].name, std::move(of)});
  }
  check_independent(named);
}

}  // namespace

Fingerprint fingerprint_of(const Scan& scan) {
  if (scan.recording) return asperity::fingerprint_of(*scan.recording);
  Fingerprint out;
  out.points = sketch_points(scan.path.motion.p_world_tip_m);
  return out;
}

ScanPoints find_scan_points(const std::vector<Scan>& scans, const RegisterConfig& config, const Observer& observer) {
  if (scans.empty()) throw Error("registration: no scan");
  ScanPoints out;
  std::vector<NamedFingerprint> named;
  for (const Scan& scan : scans) named.push_back({scan.name, fingerprint_of(scan)});
  check_independent(named);
  for (NamedFingerprint& scan : named) out.fingerprints.push_back(std::move(scan.of));
  for (const Scan& scan : scans) {
    try {
      out.motions.push_back(motion_of(scan, config, observer));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(printable(scan.name, 200) + ": " + error.what());
    }
    out.points.push_back(points_of(scan, out.motions.back().trajectory.motion, config));
    if (scan.placement) out.placement.push_back(static_cast<std::size_t>(*scan.placement));
    out.in_sequence = out.in_sequence && is_in_sequence(scan);
  }
  check_trajectories(scans, out);
  number_tips(scans, out);
  return out;
}

}  // namespace asperity

#include "asperity/studio/measured_block.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "asperity/base/units.h"
#include "asperity/json/json.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/studio/measured_metrics.h"
#include "profile_block.h"
#include "profile_gaps.h"
#include "thinned.h"

namespace asperity::studio {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Force sensors are slower than the probe: each reading holds until the next.
std::vector<double> held(const std::vector<double>& readings, std::size_t size) {
  std::vector<double> out(size, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < std::min(size, readings.size()); ++i)
    out[i] = std::isfinite(readings[i]) || i == 0 ? readings[i] : out[i - 1];
  return out;
}

void add_trajectory(const ProcessResult& result, std::size_t max_points, BlockWriter& block) {
  const TipMotion& motion = result.trajectory.motion;
  const BasePath& base = result.base.path;
  const Chosen chosen = choose_samples(motion.size(), max_points);
  const Eigen::Vector3d origin_m =
      motion.size() > 0 ? motion.p_world_tip_m[motion.size() / 2] : Eigen::Vector3d(Eigen::Vector3d::Zero());
  std::vector<double> t_s;
  for (const std::size_t i : chosen.index)
    t_s.push_back(static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s);
  block.head()["trajectory"] = {{"samples", motion.size()},
                                {"every", chosen.every},
                                {"points", chosen.index.size()},
                                {"origin_m", {origin_m.x(), origin_m.y(), origin_m.z()}},
                                {"duration_s", t_s.empty() ? 0.0 : t_s.back()}};
  block.add("trajectory_t_s", t_s);
  add_points(block, "trajectory_p_m", chosen, motion.p_world_tip_m, origin_m);
  const std::vector<double> force_N = held(motion.force_N, motion.size());
  block.add("trajectory_force_N", gather_values(chosen, [&](std::size_t i) { return force_N[i]; }));
  block.add("trajectory_sigma_m", gather_values(chosen, [&](std::size_t i) {
              return motion.cov_world_tip_m2.empty() ? kNan : std::sqrt(motion.cov_world_tip_m2[i].trace() / 3.0);
            }));

  const bool has_base = base.size() == motion.size() && base.size() > 0;
  const Chosen on_base = has_base ? chosen : Chosen{};
  add_points(block, "base_p_m", on_base, base.p_world_m, origin_m);
  block.add("trajectory_height_m", gather_values(on_base, [&](std::size_t i) {
              return base.n_world[i].dot(motion.p_world_tip_m[i] - base.p_world_m[i]);
            }));
  block.add("trajectory_speed_mps", gather_values(chosen, [&](std::size_t i) {
              return has_base ? result.base.speed_mps.at(i) : motion.v_world_tip_mps[i].norm();
            }));
  std::vector<std::uint8_t> contact;
  for (const std::size_t i : on_base.index) contact.push_back(result.base.contact[i] != 0 ? 1 : 0);
  block.add("trajectory_contact", contact);
}

void add_compliance(const Compliance& compliance, BlockWriter& block) {
  block.head()["compliance"] = {{"k_c", compliance.k_c},
                                {"k_c_stderr", compliance.k_c_stderr},
                                {"k_c_low", compliance.k_c_low},
                                {"k_c_high", compliance.k_c_high},
                                {"verdict", compliance.verdict},
                                {"sigma_r2", compliance.sigma_r2},
                                {"exponent", compliance.exponent},
                                {"exponent_error", compliance.exponent_error},
                                {"ratio_variance", compliance.ratio_variance}};
  std::vector<double> force_N, ratio, speed_mps, amplitude_mps2;
  for (const ComplianceWindow& window : compliance.windows) {
    force_N.push_back(window.force_N);
    ratio.push_back(window.ratio);
    speed_mps.push_back(window.speed_mps);
    amplitude_mps2.push_back(window.amplitude_mps2);
  }
  block.add("compliance_force_N", force_N);
  block.add("compliance_ratio", ratio);
  block.add("compliance_speed_mps", speed_mps);
  block.add("compliance_amplitude_mps2", amplitude_mps2);
}

void add_compared(const ComparedHeights& heights, BlockWriter& block) {
  block.add("compared_s_m", heights.s_m);
  block.add("compared_measured_m", std::vector<float>(heights.measured_m.begin(), heights.measured_m.end()));
  block.add("compared_true_m", std::vector<float>(heights.true_m.begin(), heights.true_m.end()));
}

void add_dropped(const ProcessResult& result, std::size_t max_gaps, BlockWriter& block) {
  Json dropped = Json::array();
  for (const Problem& problem : result.problems)
    dropped.push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
  block.head()["dropped"] = std::move(dropped);
  Json gaps = Json::array();
  const std::vector<ProfileGap> found = find_gaps(result);
  for (std::size_t i = 0; i < std::min(max_gaps, found.size()); ++i)
    gaps.push_back({{"from_m", found[i].from_m}, {"to_m", found[i].to_m}, {"why", found[i].why}});
  block.head()["gaps"] = std::move(gaps);
  block.head()["gap_count"] = found.size();
}

}  // namespace

BlockWriter measured_block(const ProcessResult& result, const Recording& recording, const std::string& name,
                           const MeasuredBlockConfig& config) {
  return measured_block(result_json(result, recording, name), result, recording, config);
}

BlockWriter measured_block(const Json& json, const ProcessResult& result, const Recording& recording,
                           const MeasuredBlockConfig& config) {
  BlockWriter block("measured");
  block.head()["result"] = json;
  block.head()["world"] = recording.info.world;
  block.head()["figures"] = measured_metrics(block.head()["result"]);
  add_dropped(result, config.max_gaps, block);
  add_trajectory(result, config.max_trajectory_points, block);
  add_profile(result.profile, config.max_profile_points, block);
  add_spectrum(result.spectrum, block);
  add_compliance(result.compliance, block);
  if (result.accuracy) add_compared(result.accuracy->heights, block);
  return block;
}

}  // namespace asperity::studio

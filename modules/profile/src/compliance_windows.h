#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "asperity/geometry/motion.h"
#include "asperity/profile/estimate_compliance.h"

namespace asperity {

// The windows of a scan that count, with the power of the curvature of the tip's path in the band: Σ_k |h″_k|² / q_k
// over the frequencies q_k = k / window_mm, as a density, and what of it is there when the probe rests.
struct ComplianceWindows {
  std::vector<double> force_N, speed_mps, power, noise;
  double rest_amplitude_mps2 = 0.0;
  std::size_t moving = 0;  // windows fast and firm enough, those included in which the tip left the surface
  std::size_t lost = 0;
};

// Forces bridged over gaps; sizes as estimate_compliance() demands. No windows where there is no force.
ComplianceWindows cut_compliance_windows(const TipMotion& samples, std::span<const std::int64_t> normal_t_ns,
                                         std::span<const Eigen::Vector3d> n_world, const ComplianceConfig& config);

}  // namespace asperity

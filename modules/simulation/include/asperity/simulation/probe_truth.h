#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "asperity/recording/calibration.h"
#include "asperity/simulation/probe_config.h"
#include "asperity/simulation/tracker_config.h"

namespace asperity {

// What a probe's sensors truly do: counts = B f + C and so on, as in calibration.h. The stated
// calibration of a recording differs from it by the errors of its making.
// The model `what` has the thesis's printed B and C (§3.5; B taken as counts per g, erratum 5) and the force
// line of Fig. 11; `open` has even scales with small misalignments and offsets drawn from `seed`.
Calibration make_probe_truth(const SimulatedProbeConfig& probe, const SimulatedTrackerConfig& tracker,
                             std::uint64_t seed);

// `truth` with errors of the sizes in `config` added, and their sizes stated: what a careful person's
// calibration would have given. `sigma_*` are the tracker's noise at the recording's mean pose.
Calibration make_stated_calibration(const Calibration& truth, const SimulatedProbeConfig& probe,
                                    const SimulatedCalibrationConfig& config, const Eigen::Vector3d& sigma_position_m,
                                    const Eigen::Vector3d& sigma_rotation_rad, std::uint64_t seed);

}  // namespace asperity

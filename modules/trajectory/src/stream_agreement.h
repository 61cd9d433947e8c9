#pragma once

#include "inertial_forward.h"

// Whether the two streams are of the same motion: what the model has no freedom for, estimated by the filter's own
// gains (docs/trajectory.md).
namespace asperity::inertial_smoother {

// `records` of a forward pass of `problem`, which has no restarts; `smoothed` with the poses' residuals. The
// deviations' regressors are filtered by the same gains, and the innovations regressed on theirs (Rosenberg, Annals of
// Econ. and Soc. Measurement 2, 1973; de Jong, Annals of Statistics 19, 1991).
StreamAgreement compare_streams(const Problem& problem, ForwardRecords& records, const Smoothed& smoothed);

}  // namespace asperity::inertial_smoother

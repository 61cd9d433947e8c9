#pragma once

#include "asperity/import/check_streams.h"

namespace asperity {

// The part of check_streams on the positions' unit and axes: regression of their second differences on the twice
// integrated specific force. Where these are not related (cosine below 0.7), other axes of the accelerometer and of the
// positions are tried; one above 0.9 is a doubt. False: not determined.
bool check_lengths(const ImportStreams& streams, const StreamUnits& units, StreamChecks& out);

// The cosine of both where the accelerometer's axes are exchanged by `axes`; 0 where it is not determined.
double length_cosine(const ImportStreams& streams, const Eigen::Matrix3d& axes);

}  // namespace asperity

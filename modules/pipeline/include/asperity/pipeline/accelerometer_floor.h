#pragma once

#include <limits>

#include "asperity/recording/recording.h"

namespace asperity {

// What an accelerometer has at its highest frequencies, against the white noise that its calibration states.
struct AccelerometerFloor {
  // Power densities from half to 0.9 of the Nyquist frequency over the stated noise's: the median over frequencies, of
  // that channel which has most. nan: not known.
  double ratio = std::numeric_limits<double>::quiet_NaN();
  // The same density times the Nyquist frequency over 1/12 count², the power of rounding to whole counts. nan: readings
  // are not whole counts (they were averaged or converted after the converter).
  double rounding_ratio = std::numeric_limits<double>::quiet_NaN();
  double from_Hz = std::numeric_limits<double>::quiet_NaN();  // from where on it is below a quarter of it, by octaves
};

// A sensor's own noise is white to the end of its band, whatever the probe touches. Where a signal has less than it, it
// was smoothed after it was measured: by the sensor's own filter, averaging or an export, which have taken the
// surface's vibrations as well. A calibration can state a noise that is too large (the misfit of its model counts):
// readings that were smoothed have nothing but rounding left. Readings are taken as evenly spaced (Welch's estimate,
// segments of 1,024 samples). Not known without a stated noise (`residual_counts`), or of fewer than 4,096 readings.
AccelerometerFloor accelerometer_floor(const Recording& recording);

}  // namespace asperity

#pragma once

#include <string>

#include "asperity/calibration/calibrate_imu.h"
#include "asperity/recording/calibration.h"

namespace asperity {

// Puts what calibrate_imu found with the calibration `used` into `calibration`: the accelerometer's place and the
// latency with their standard errors; the accelerometer's and the gyroscope's rotation where `used` did not know it, or
// where it is more than four standard errors off what `used` has (a linear model only). A gyroscope without a
// calibration gets one.
void store_imu(const ImuCalibration& imu, const Calibration& used, Calibration& calibration);

// For a person: what of the rotation store_imu() puts there, and why.
std::string imu_storage_text(const ImuCalibration& imu, const Calibration& used);

}  // namespace asperity

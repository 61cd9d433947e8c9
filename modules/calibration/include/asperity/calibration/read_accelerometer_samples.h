#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/calibration/accelerometer_samples.h"
#include "asperity/recording/recording.h"

namespace asperity {

struct AccelerometerFile {
  AccelerometerSamples samples;
  std::vector<std::string> notes;  // what was taken for granted or left out, one sentence each
};

// A table with the columns t_s,accel_i,accel_j,accel_k and, where the specific force is known, fx_mps2,fy_mps2,fz_mps2;
// or four bare numbers a line, t i j k, parted by blanks or commas, which is said in the notes. Rows whose time does
// not rise are left out and counted in the notes. Throws Error naming file, line and column for what is no finite
// number, for only part of the force's columns, and for files above 1 GiB.
AccelerometerFile read_accelerometer_samples(const std::filesystem::path& file);

// The probe's rows, times from the first row on. Rows at the converter's limits, if the recording states them, are
// left out and counted in the notes.
AccelerometerFile accelerometer_samples_of(const Recording& recording);

}  // namespace asperity

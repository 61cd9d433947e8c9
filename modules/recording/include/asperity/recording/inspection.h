#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace asperity {

// When the rows of a stream came. Values of intervals are nan for a single row.
struct StreamTiming {
  std::size_t count = 0;
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  double duration_s = 0.0;
  double median_rate_Hz = std::numeric_limits<double>::quiet_NaN();
  double mean_rate_Hz = std::numeric_limits<double>::quiet_NaN();
  double period_s = std::numeric_limits<double>::quiet_NaN();  // mean of the intervals without a loss
  double jitter_s = std::numeric_limits<double>::quiet_NaN();  // standard deviation of those intervals
  std::int64_t clock_step_ns = 0;                              // greatest common divisor of the intervals
  std::size_t gaps = 0;                                        // intervals longer than 1.5 periods
  double longest_gap_s = 0.0;
  std::size_t lost = 0;  // rows that the gaps would hold at one a period
  double lost_share = 0.0;
  std::size_t duplicates = 0;  // rows left out when reading because their time came twice
};

// One column of the probe, in counts.
struct ChannelStatistics {
  std::string name;
  std::size_t samples = 0;  // rows with a value
  double lowest = std::numeric_limits<double>::quiet_NaN();
  double highest = std::numeric_limits<double>::quiet_NaN();
  double saturated_share = std::numeric_limits<double>::quiet_NaN();  // at adc_min or adc_max; nan: range unknown
  double quiet_mean = std::numeric_limits<double>::quiet_NaN();       // over the quietest stretch
  double quiet_noise = std::numeric_limits<double>::quiet_NaN();      // standard deviation over it
};

// The stretch in which the accelerometer varied least.
struct QuietInterval {
  double start_s = 0.0;  // since the probe's first row
  double duration_s = 0.0;
  bool at_rest = false;                                               // still enough for the values below to be noise
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();      // mean, in the marker frame
  Eigen::Vector3d acceleration_noise_mps2 = Eigen::Vector3d::Zero();  // standard deviation, in the marker frame
  double gravity_mps2 = 0.0;                                          // length of the mean specific force
  // Between the mean specific force, turned into the world, and up; nan without a pose or a known rotation.
  double gravity_angle_rad = std::numeric_limits<double>::quiet_NaN();
  double force_N = std::numeric_limits<double>::quiet_NaN();
  std::size_t poses = 0;
  // Of the tracker along the world's axes, from frame to frame (differences over √2); nan below 5 poses.
  Eigen::Vector3d position_noise_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d rotation_noise_rad = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

// What a recording looks like, and what looks wrong with it.
struct Inspection {
  StreamTiming probe;
  StreamTiming tracker;
  double overlap_s = 0.0;
  std::vector<ChannelStatistics> channels;
  std::optional<QuietInterval> quiet;  // nullopt: too short a recording
  double force_lowest_N = std::numeric_limits<double>::quiet_NaN();
  double force_highest_N = std::numeric_limits<double>::quiet_NaN();
  double force_rate_Hz = 0.0;
  std::size_t flips = 0;              // poses that jump away from their neighbours
  std::vector<std::string> findings;  // sentences on what looks wrong; empty: nothing does
};

}  // namespace asperity

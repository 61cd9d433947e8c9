#pragma once

#include <limits>
#include <span>
#include <vector>

#include "asperity/pipeline/process_result.h"
#include "asperity/recording/recording.h"

namespace asperity {

// What repeatability is judged by, of one scan.
struct RepeatedScan {
  Profile profile;
  Periodicity periodicity;
  double speed_mps = 0.0;      // mean, over the profile
  double probe_rate_Hz = 0.0;  // mean
};

RepeatedScan repeated_scan(const ProcessResult& result, const Recording& recording);

struct MeanAndSpread {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();  // standard deviation over the scans; nan for one
  std::size_t count = 0;
};

// Scans of the same surface, laid over one another (seed Fig. 30).
struct Repeatability {
  std::vector<ProfileComparison> with_first;  // one a scan, the first one's with itself
  std::vector<double> s_m;                    // along the first profile
  std::vector<std::vector<double>>
      height_m;                     // one a scan, at every s, band-passed and shifted; nan where there is none
  std::vector<double> mean_m;       // of the scans, nan where one of them has no height
  std::vector<double> deviation_m;  // standard deviation over the scans, likewise
  double band_high_cycles_per_mm = 0.0;
  MeanAndSpread pitch_m, depth_m;                                  // of the scans whose texture is periodic
  MeanAndSpread correlation;                                       // with the first, of the others
  double spread_rms_m = std::numeric_limits<double>::quiet_NaN();  // root mean square of deviation_m
};

// Each scan is aligned to the first by one rigid shift and compared with it in the band from config.low_cycles_per_mm
// to the smaller of config.high_cycles_per_mm and 0.4·rate/speed of the scan where that is lowest (compare_profiles.h).
// Throws Error for fewer than two scans or more than 64, and as compare_profiles() does.
Repeatability measure_repeatability(std::span<const RepeatedScan> scans, const ComparisonConfig& config);

}  // namespace asperity

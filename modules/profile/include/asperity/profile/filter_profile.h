#pragma once

#include <span>
#include <vector>

#include "asperity/profile/measure_roughness.h"

namespace asperity {

// The profiles of ISO 21920-2, uniform, each of mean zero; nan where the heights are missing.
struct FilteredProfiles {
  std::vector<double> primary_m;    // P: less the form, low-passed by λs
  std::vector<double> roughness_m;  // R: P less its mean line by λc; P without λc
  std::vector<double> waviness_m;   // W: the mean line by λc, less its own mean line by λf; empty without λc
};

// P, R and W of heights `spacing_m` apart. λs is always Gaussian, λc and λf by `config.filter`. With `config.ends` cut,
// half of λc (R and W), and half of λf more (W), is left out at either end: what filters reach beyond the ends for.
// W is empty where it would leave nothing. Throws Error as measure_roughness() does, and where nothing would be left of
// R.
FilteredProfiles filter_profile(std::span<const double> height_m, double spacing_m, const RoughnessConfig& config = {},
                                const Observer& observer = {});

}  // namespace asperity

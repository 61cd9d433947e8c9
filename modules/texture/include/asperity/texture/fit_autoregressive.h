#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/texture/autoregressive.h"

namespace asperity {

enum class OrderCriterion { kBic, kAic };
inline constexpr std::array<std::string_view, 2> kOrderCriterionNames{"bic", "aic"};

struct FitAutoregressiveConfig {
  double high_pass_Hz = 10.0;
  double window_s = 0.05;
  double min_speed_mps = 2e-3;
  double min_force_N = 0.02;
  int max_models = 24;
  double seconds_per_model = 1.0;
  int min_order = 2;
  int max_order = 20;
  OrderCriterion criterion = OrderCriterion::kBic;
  double mass_kg = 0.05;
  bool hold_out_half = true;
  double block_s = 1.0;
  int bands = 8;
  int realisations = 8;
  std::int64_t seed = 1;

  template <class V>
  void visit(V& v) {
    v.field("high_pass_Hz", high_pass_Hz, "slower motion is the hand's, not the texture's; 0: all is kept", {0.0, 1e5});
    v.field("window_s", window_s, "speed and force are taken as constant over this", {1e-3, 10.0});
    v.field("min_speed_mps", min_speed_mps, "slower windows are not stroking", {0.0, 10.0});
    v.field("min_force_N", min_force_N, "windows of less force are not in contact", {0.0, 100.0});
    v.field("max_models", max_models, "points of the speed-force plane, at most", {1, kMaxSeriesModels});
    v.field("seconds_per_model", seconds_per_model, "fewer models where the recording is shorter than that for each",
            {1e-3, 1e4});
    v.field("min_order", min_order, "lowest order tried", {1, 32});
    v.field("max_order", max_order, "highest order tried", {1, 32});
    v.choice("criterion", criterion, kOrderCriterionNames, "what chooses the order");
    v.field("mass_kg", mass_kg, "effective mass of tool and hand", {0.0, 1e3});
    v.field("hold_out_half", hold_out_half, "measure the error of a fit to one half on the other");
    v.field("block_s", block_s, "the halves are every other block of this length", {1e-2, 1e5});
    v.field("bands", bands, "of the spectrum that are compared", {1, 64});
    v.field("realisations", realisations, "of the synthesis that are averaged", {1, 1000});
    v.field("seed", seed, "of the synthesis", {0, 9e15});
  }
};

// A recording of one texture: acceleration of the tool (high-frequency part, one axis or reduced to one), speed along
// the surface and normal force, sampled together.
struct SeriesRecording {
  std::span<const double> acceleration_mps2;
  std::span<const double> speed_mps;
  std::span<const double> force_N;
  double rate_Hz = 1000.0;
};

// A synthesis against a recording, over the windows of the recording that stroke.
struct SeriesError {
  double recorded_variance = 0.0;      // (m/s²)²
  double variance_error = 0.0;         // relative, signed
  std::vector<double> band_Hz;         // upper ends; the first begins at high_pass_Hz
  std::vector<double> recorded_power;  // per band, (m/s²)²
  std::vector<double> synthesised_power;
  double spectrum_error = 0.0;    // Σ |ΔP| / Σ P over the bands
  double worst_band_error = 0.0;  // largest |ΔP| / P of the bands with at least 2 % of the power
  std::size_t samples = 0;
};

struct AutoregressiveFit {
  AutoregressiveTexture texture;  // of the whole recording
  int order = 0;
  std::size_t samples = 0;                 // that stroke
  std::vector<std::size_t> model_samples;  // per model
  std::vector<double> order_cost;          // the criterion, from min_order on
  SeriesError held_out;                    // fit to one half, measured on the other
  Problems problems;                       // "few_samples", "no_held_out"
};

// Autoregressive models of a recording: windows of constant speed and force are gathered into groups of like speed and
// force (k-means from the farthest points, without randomness), and each group is one model at its mean: reflection
// coefficients by Burg's method for segments (de Waele and Broersen 2000), one order for all by the criterion over all
// groups. Culbertson et al. 2014 part the recording where it changes and make a model of each part; grouping gives one
// model all the visits to its speed and force. Throws Error for spans of unequal length, samples that are not finite,
// or less than two windows that stroke.
AutoregressiveFit fit_autoregressive(const SeriesRecording& recording, const FitAutoregressiveConfig& config = {});

// Synthesises at the recording's speed and force, and compares. Throws Error as above.
SeriesError measure_series_error(const AutoregressiveTexture& texture, const SeriesRecording& recording,
                                 const FitAutoregressiveConfig& config = {});

}  // namespace asperity

#include "asperity/texture/fit_autoregressive.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/texture/autoregressive_filter.h"
#include "burg.h"
#include "series_windows.h"

namespace asperity {
namespace {

struct Group {
  double speed_mps = 0.0;
  double force_N = 0.0;
  std::size_t samples = 0;
  std::vector<std::span<const double>> segments;  // windows of the group that follow each other are one
};

std::vector<Group> gather_groups(const std::vector<SeriesWindow>& windows, const std::vector<int>& number,
                                 std::span<const double> x) {
  std::vector<Group> groups(static_cast<std::size_t>(*std::max_element(number.begin(), number.end())) + 1);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    auto& g = groups[static_cast<std::size_t>(number[i])];
    const auto& w = windows[i];
    g.speed_mps += w.speed_mps * static_cast<double>(w.count);
    g.force_N += w.force_N * static_cast<double>(w.count);
    g.samples += w.count;
    const bool follows = i > 0 && number[i - 1] == number[i] && windows[i - 1].first + windows[i - 1].count == w.first;
    if (follows) {
      auto& last = g.segments.back();
      last = {last.data(), last.size() + w.count};
    } else {
      g.segments.push_back(x.subspan(w.first, w.count));
    }
  }
  for (auto& g : groups) {
    g.speed_mps /= static_cast<double>(g.samples);
    g.force_N /= static_cast<double>(g.samples);
  }
  return groups;
}

// Σ over the groups of N ln σ²_p + penalty · p.
std::vector<double> order_costs(const std::vector<Group>& groups, const std::vector<BurgResult>& filters,
                                const FitAutoregressiveConfig& config) {
  std::vector<double> costs;
  for (int p = config.min_order; p <= config.max_order; ++p) {
    double cost = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double n = static_cast<double>(groups[g].samples);
      const double penalty = config.criterion == OrderCriterion::kBic ? std::log(n) : 2.0;
      const double variance = filters[g].variance[static_cast<std::size_t>(p)];
      cost += (variance > 0.0 ? n * std::log(variance) : 0.0) + penalty * static_cast<double>(p);
    }
    costs.push_back(cost);
  }
  return costs;
}

AutoregressiveFit fit_once(const SeriesRecording& recording, const FitAutoregressiveConfig& config) {
  const auto x = vibration_mps2(recording, config);
  const auto windows = stroking_windows(recording, config);
  if (windows.size() < 2) {
    throw Error("texture: " + std::to_string(windows.size()) + " windows of " + number_text(config.window_s) +
                " s stroke with at least " + number_text(config.min_speed_mps) + " m/s and " +
                number_text(config.min_force_N) + " N; two are needed");
  }
  AutoregressiveFit fit;
  const double stroked_s = static_cast<double>(windows.size() * windows.front().count) / recording.rate_Hz;
  const int groups_wanted =
      static_cast<int>(std::clamp(std::floor(stroked_s / config.seconds_per_model), 1.0, double(config.max_models)));
  const auto least = std::max<std::size_t>(
      2, static_cast<std::size_t>(0.5 * config.seconds_per_model * recording.rate_Hz / windows.front().count));
  const auto groups = gather_groups(windows, group_windows(windows, groups_wanted, least), x);
  std::vector<BurgResult> filters;
  for (const auto& g : groups) {
    filters.push_back(burg(g.segments, config.max_order));
    fit.samples += g.samples;
    fit.model_samples.push_back(g.samples);
    if (g.samples < 20 * static_cast<std::size_t>(config.max_order)) {
      fit.problems.push_back({"few_samples",
                              "the model at " + rounded_text(1e3 * g.speed_mps) + " mm/s and " +
                                  rounded_text(g.force_N) + " N is based on " + std::to_string(g.samples) + " samples",
                              1});
    }
  }
  fit.order_cost = order_costs(groups, filters, config);
  const auto best = std::min_element(fit.order_cost.begin(), fit.order_cost.end());
  fit.order = config.min_order + static_cast<int>(best - fit.order_cost.begin());

  fit.texture.rate_Hz = recording.rate_Hz;
  fit.texture.mass_kg = config.mass_kg;
  fit.texture.fade_speed_mps = std::max(config.min_speed_mps, 1e-6);
  fit.texture.fade_force_N = std::max(config.min_force_N, 1e-6);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto order = static_cast<std::size_t>(fit.order);
    const std::span<const double> k(filters[g].k);
    AutoregressiveModel model;
    model.speed_mps = groups[g].speed_mps;
    model.force_N = groups[g].force_N;
    model.ar_lsf_rad = reflection_to_lsf(k.first(order));
    model.variance = filters[g].variance[order];
    fit.texture.models.push_back(std::move(model));
  }
  prepare_autoregressive(fit.texture, "texture");
  return fit;
}

void check_config(const FitAutoregressiveConfig& c) {
  if (c.min_order < 1 || c.max_order > 32 || c.max_order < c.min_order)
    throw Error("texture: orders from " + std::to_string(c.min_order) + " to " + std::to_string(c.max_order) +
                " are not within 1 and 32");
  if (c.max_models < 1 || c.max_models > kMaxSeriesModels || !(c.seconds_per_model > 0.0) || !(c.window_s > 0.0))
    throw Error("texture: max_models " + std::to_string(c.max_models) + ", seconds_per_model " +
                number_text(c.seconds_per_model) + " or window_s " + number_text(c.window_s) + " is out of range");
}

// Half of a recording.
struct Half {
  std::vector<double> acceleration_mps2, speed_mps, force_N;
  double rate_Hz = 0.0;

  SeriesRecording recording() const { return {acceleration_mps2, speed_mps, force_N, rate_Hz}; }
};

// Blocks `block_s` long, every other one from the first or the second on: both halves then have met all speeds and
// forces, also where the recording goes from light to firm.
Half every_other_block(const SeriesRecording& recording, double block_s, std::size_t from) {
  const auto block = static_cast<std::size_t>(std::max(1.0, std::round(block_s * recording.rate_Hz)));
  Half out;
  out.rate_Hz = recording.rate_Hz;
  for (std::size_t begin = from * block; begin < recording.acceleration_mps2.size(); begin += 2 * block) {
    const std::size_t count = std::min(block, recording.acceleration_mps2.size() - begin);
    const auto copy = [&](std::span<const double> source, std::vector<double>& to) {
      const auto piece = source.subspan(begin, count);
      to.insert(to.end(), piece.begin(), piece.end());
    };
    copy(recording.acceleration_mps2, out.acceleration_mps2);
    copy(recording.speed_mps, out.speed_mps);
    copy(recording.force_N, out.force_N);
  }
  return out;
}

}  // namespace

AutoregressiveFit fit_autoregressive(const SeriesRecording& recording, const FitAutoregressiveConfig& config) {
  check_recording(recording);
  check_config(config);
  AutoregressiveFit fit = fit_once(recording, config);
  if (!config.hold_out_half) return fit;
  const Half fitted = every_other_block(recording, config.block_s, 0),
             kept = every_other_block(recording, config.block_s, 1);
  const SeriesRecording first = fitted.recording(), second = kept.recording();
  if (stroking_windows(first, config).size() < 2 || stroking_windows(second, config).size() < 2) {
    fit.problems.push_back({"no_held_out", "one half of the recording has no stroke: the error was not measured", 1});
  } else {
    fit.held_out = measure_series_error(fit_once(first, config).texture, second, config);
  }
  return fit;
}

}  // namespace asperity

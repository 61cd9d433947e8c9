#include "asperity/profile/merge_passes.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "average_passes.h"
#include "compare_passes.h"
#include "noise_of_merge.h"
#include "pass_signal.h"
#include "spectrum_at.h"
#include "warp_pass.h"

namespace asperity {

namespace {

constexpr int kRounds = 2;

// A pass laid on the reference's points: places in the heights of its signal, in its own direction.
struct LaidPass {
  const ProfilePass* pass = nullptr;
  PassSignal signal;
  bool is_reversed = false;
  std::vector<double> places;
};

struct Chosen {
  std::size_t reference = 0;
  std::vector<PassAlignment> alignments;  // of each pass on the reference
};

// The pass with which the most others agree. `false_alarm` is that of any pair of them.
Chosen choose_reference(std::span<const ProfilePass> passes, AlignPassesConfig config) {
  const double count = static_cast<double>(passes.size());
  config.false_alarm /= 0.5 * count * (count - 1.0);
  Chosen best;
  double most = -1.0;
  for (std::size_t r = 0; r < passes.size(); ++r) {
    Chosen one{r, std::vector<PassAlignment>(passes.size())};
    double agreeing = 0.0, score = 0.0;
    for (std::size_t k = 0; k < passes.size(); ++k) {
      if (k == r) continue;
      one.alignments[k] = align_passes(passes[r], passes[k], config);
      agreeing += one.alignments[k].agrees ? 1.0 : 0.0;
      score += one.alignments[k].agrees ? one.alignments[k].score : 0.0;
    }
    const double length = static_cast<double>(passes[r].size());
    const double value = agreeing * 1e6 + score / (score + 1.0) + 1e-9 * length;
    if (value <= most) continue;
    most = value;
    best = std::move(one);
    // No other has more.
    if (agreeing == static_cast<double>(passes.size() - 1)) break;
  }
  return best;
}

bool is_known(const PassSignal& signal, double place) {
  if (!(place >= 0.0) || place > static_cast<double>(signal.size() - 1)) return false;
  const auto i = static_cast<std::size_t>(place);
  return signal.known[i] != 0 && signal.known[std::min(i + 1, signal.size() - 1)] != 0;
}

// The mean of all passes but one on the reference's points, by their noise in all; of one other, that.
WarpTarget mean_of_others(const std::vector<LaidPass>& laid, std::size_t without) {
  const std::size_t points = laid.front().places.size();
  WarpTarget out{
      std::vector<double>(points, 0.0), std::vector<char>(points, 0), laid.front().signal.frequency, {}, true};
  out.noise.assign(out.frequency.size(), 0.0);
  std::vector<double> weight(points, 0.0);
  double total = 0.0;
  for (std::size_t k = 0; k < laid.size(); ++k) {
    if (k == without) continue;
    const PassSignal& signal = laid[k].signal;
    double power = 0.0;
    for (const double density : signal.noise) power += density;
    const double w = 1.0 / power;
    total += w;
    out.states_noise = out.states_noise && signal.states_noise;
    for (std::size_t i = 0; i < out.noise.size(); ++i)
      out.noise[i] += w * w * spectrum_at(signal.frequency, signal.noise, out.frequency[i]);
    for (std::size_t i = 0; i < points; ++i) {
      if (!is_known(signal, laid[k].places[i])) continue;
      out.height_m[i] += w * height_at(signal.height_m, laid[k].places[i]);
      weight[i] += w;
    }
  }
  for (double& density : out.noise) density /= total * total;
  for (std::size_t i = 0; i < points; ++i) {
    if (!(weight[i] > 0.0)) continue;
    out.height_m[i] /= weight[i];
    out.known[i] = 1;
  }
  return out;
}

// Rising x(i) read backwards: the i at which x has even values from `first` on.
std::vector<double> even_places(const std::vector<double>& x, double first, std::size_t count) {
  std::vector<double> out(count);
  std::size_t i = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const double at = first + static_cast<double>(j);
    while (i + 2 < x.size() && x[i + 1] < at) ++i;
    const double step = x[i + 1] - x[i];
    out[j] = static_cast<double>(i) + (step > 0.0 ? std::clamp((at - x[i]) / step, 0.0, 1.0) : 0.0);
  }
  return out;
}

// The places on the mean of the passes' paths: lengths along it are the mean of theirs.
void lay_on_mean_path(std::vector<LaidPass>& laid) {
  const std::size_t points = laid.front().places.size();
  std::vector<double> mean(points, 0.0);
  for (const LaidPass& one : laid) {
    for (std::size_t i = 0; i < points; ++i)
      mean[i] += (one.places[i] - one.places.front()) / static_cast<double>(laid.size());
  }
  // A path that does not go back has an inverse.
  for (std::size_t i = 1; i < points; ++i) mean[i] = std::max(mean[i], mean[i - 1] + 1e-9);
  const auto count = static_cast<std::size_t>(std::floor(mean.back())) + 1;
  const std::vector<double> at = even_places(mean, 0.0, count);
  for (LaidPass& one : laid) {
    std::vector<double> places(count);
    for (std::size_t j = 0; j < count; ++j) {
      const auto i = std::min(static_cast<std::size_t>(at[j]), points - 2);
      const double u = at[j] - static_cast<double>(i);
      places[j] = one.places[i] + u * (one.places[i + 1] - one.places[i]);
    }
    one.places = std::move(places);
  }
}

double point_of(const LaidPass& laid, double place) {
  const double in_signal = laid.is_reversed ? static_cast<double>(laid.signal.size() - 1) - place : place;
  return in_signal + static_cast<double>(laid.signal.first);
}

// Where each point of the pass is on the merge.
std::vector<double> places_on_merge(const LaidPass& laid) {
  std::vector<double> out(laid.pass->size(), kNan);
  const double last = static_cast<double>(laid.pass->size() - 1);
  for (std::size_t j = 0; j + 1 < laid.places.size(); ++j) {
    const double from = point_of(laid, laid.places[j]), to = point_of(laid, laid.places[j + 1]);
    const double low = std::max(0.0, std::min(from, to)), high = std::min(std::max(from, to), last);
    for (double i = std::ceil(low); i <= high && from != to; i += 1.0)
      out[static_cast<std::size_t>(i)] = static_cast<double>(j) + (i - from) / (to - from);
  }
  return out;
}

PassOnGrid on_grid(const LaidPass& laid) {
  PassOnGrid out;
  out.pass = laid.pass;
  const std::vector<double>& sigma_m = laid.pass->added_sigma_m;
  double mean_m2 = 0.0, count = 0.0;
  for (const double sigma : sigma_m) {
    if (!(sigma > 0.0)) continue;
    mean_m2 += sigma * sigma;
    count += 1.0;
  }
  const double usual_m = count > 0.0 ? std::sqrt(mean_m2 / count) : 0.0;
  for (const double place : laid.places) {
    const double point = point_of(laid, place);
    const auto nearest =
        static_cast<std::size_t>(std::clamp(std::round(point), 0.0, static_cast<double>(laid.pass->size() - 1)));
    const bool known = is_known(laid.signal, place);
    out.texture_m.push_back(height_at(laid.signal.height_m, place));
    out.known.push_back(known ? 1 : 0);
    out.slow_m.push_back(known && !laid.pass->slow_m.empty() ? laid.pass->slow_m[nearest] : kNan);
    const bool varies = usual_m > 0.0 && sigma_m[nearest] > 0.0;
    out.noisier.push_back(varies ? std::clamp(sigma_m[nearest] / usual_m, 0.1, 10.0) : 1.0);
  }
  return out;
}

// What a pass' noise counts as: what it states, or what its differences from the others show where that is more.
void set_noise(PassOnGrid& pass, const PassDifferences& differences, std::size_t k) {
  if (pass.pass->noise_psd_m2_mm.empty()) return;
  pass.frequency_cycles_per_mm = pass.pass->frequency_cycles_per_mm;
  pass.noise_psd_m2_mm = pass.pass->noise_psd_m2_mm;
  if (differences.noise_m2.empty() || !(differences.noise_m2[k] > 0.0)) return;
  double mean_m2 = 0.0;
  for (const double noise_m2 : differences.noise_m2)
    mean_m2 += noise_m2 / static_cast<double>(differences.noise_m2.size());
  const double own = differences.noise_m2[k] / mean_m2;
  std::vector<double>& frequency = pass.frequency_cycles_per_mm;
  frequency.insert(frequency.end(), differences.frequency_cycles_per_mm.begin(),
                   differences.frequency_cycles_per_mm.end());
  std::sort(frequency.begin(), frequency.end());
  frequency.erase(std::unique(frequency.begin(), frequency.end()), frequency.end());
  pass.noise_psd_m2_mm.clear();
  for (const double f : frequency) {
    const double shown_m2_mm = own * spectrum_at(differences.frequency_cycles_per_mm, differences.scatter_psd_m2_mm, f);
    pass.noise_psd_m2_mm.push_back(std::max(stated_noise_m2_mm(*pass.pass, f), shown_m2_mm));
  }
}

// Shift, stretch and the rest of a pass' places.
void describe_places(const LaidPass& laid, double spacing_m, MergedPass& out) {
  const std::size_t points = laid.places.size();
  const double last = static_cast<double>(points - 1);
  const double begin = laid.places.front(), slope = (laid.places.back() - begin) / last;
  double square = 0.0;
  for (std::size_t i = 0; i < points; ++i)
    square += std::pow(laid.places[i] - begin - slope * static_cast<double>(i), 2);
  const double first = laid.is_reversed
                           ? static_cast<double>(laid.pass->size() - laid.signal.first - laid.signal.size())
                           : static_cast<double>(laid.signal.first);
  out.shift_m = spacing_m * (begin + first);
  out.stretch = slope - 1.0;
  out.warp_rms_m = spacing_m * std::sqrt(square / static_cast<double>(points));
}

std::vector<LaidPass> lay_passes(std::span<const ProfilePass> passes, const Chosen& chosen,
                                 const AlignPassesConfig& config) {
  std::vector<LaidPass> laid;
  const auto place_sigma = [&](const ProfilePass& pass) {
    return 1e3 * (std::isfinite(pass.place_sigma_m) ? pass.place_sigma_m : config.place_sigma_m);
  };
  const PassSignal reference = pass_signal(passes[chosen.reference]);
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const PassAlignment& at = chosen.alignments[k];
    if (k != chosen.reference && !at.agrees) continue;
    LaidPass& one = laid.emplace_back();
    one.pass = &passes[k];
    one.signal = pass_signal(passes[k]);
    if (at.reversed) one.signal = reversed(std::move(one.signal));
    one.is_reversed = at.reversed;
    one.places.resize(reference.size());
    const double first = at.reversed ? static_cast<double>(passes[k].size() - one.signal.first - one.signal.size())
                                     : static_cast<double>(one.signal.first);
    for (std::size_t i = 0; i < one.places.size(); ++i) {
      one.places[i] = k == chosen.reference ? static_cast<double>(i)
                                            : at.shift_m / passes[k].spacing_m - first +
                                                  static_cast<double>(i + reference.first) * (1.0 + at.stretch);
    }
    if (k == chosen.reference) continue;
    const WarpTarget target{reference.height_m, reference.known, reference.frequency, reference.noise,
                            reference.states_noise};
    const double sigma_mm = std::hypot(place_sigma(passes[k]), place_sigma(passes[chosen.reference]));
    WarpedPlaces warped = warp_pass(target, one.signal, one.places, {sigma_mm, 1e3 * config.knot_spacing_m}, config);
    one.places = std::move(warped.places);
    if (!warped.converged) laid.pop_back();
  }
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < laid.size() && laid.size() > 2;) {
      WarpedPlaces warped = warp_pass(mean_of_others(laid, k), laid[k].signal, laid[k].places,
                                      {place_sigma(*laid[k].pass), 1e3 * config.knot_spacing_m}, config);
      laid[k].places = std::move(warped.places);
      if (warped.converged) {
        ++k;
      } else {
        laid.erase(laid.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
  }
  return laid;
}

}  // namespace

MergedProfile merge_passes(std::span<const ProfilePass> passes, const AlignPassesConfig& config) {
  if (passes.size() < 2) throw Error("merge: " + std::to_string(passes.size()) + " pass, at least 2 are needed");
  MergedProfile out;
  const Chosen chosen = choose_reference(passes, config);
  for (std::size_t k = 0; k < passes.size(); ++k) {
    MergedPass& pass = out.passes.emplace_back();
    pass.name = passes[k].name;
    pass.alignment = chosen.alignments[k];
    pass.used = k == chosen.reference || chosen.alignments[k].agrees;
    out.used += pass.used ? 1U : 0U;
  }
  const auto none = [&] {
    for (MergedPass& pass : out.passes) pass.used = false;
    out.used = 0;
    out.agrees = false;
    return std::move(out);
  };
  if (out.used < 2) return none();
  std::vector<LaidPass> laid = lay_passes(passes, chosen, config);
  for (std::size_t k = 0; k < passes.size(); ++k) {
    if (!out.passes[k].used) continue;
    out.passes[k].used =
        std::any_of(laid.begin(), laid.end(), [&](const LaidPass& one) { return one.pass == &passes[k]; });
    out.passes[k].laid = out.passes[k].used;
  }
  out.used = laid.size();
  if (out.used < 2) return none();
  out.agrees = true;
  lay_on_mean_path(laid);

  const double spacing_m = passes[chosen.reference].spacing_m;
  std::vector<PassOnGrid> grid;
  for (const LaidPass& one : laid) grid.push_back(on_grid(one));
  const PassDifferences differences = compare_passes(grid, 1e3 * spacing_m, config);
  for (std::size_t k = 0; k < grid.size(); ++k) set_noise(grid[k], differences, k);
  AveragedPasses mean = average_passes(grid, 1e3 * spacing_m);
  out.noise = noise_of_merge(mean, grid, 1e3 * spacing_m, config.place_sigma_m);
  out.noise_ratio = differences.ratio;
  out.noise_ratio_low = differences.ratio_low;
  out.noise_ratio_high = differences.ratio_high;
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < out.passes.size(); ++k) {
    if (out.passes[k].used) used.push_back(k);
  }
  out.closest = {used[differences.closest_first], used[differences.closest_second], differences.closest_ratio,
                 differences.closest_ratio_high};
  out.noise_scale = differences.parts.noise_scale;
  out.apart_m = differences.parts.apart_m;
  if (differences.parts.noise_m2 > 0.0) out.lines_over_noise = differences.parts.lines_m2 / differences.parts.noise_m2;
  out.scatter_frequency_cycles_per_mm = differences.frequency_cycles_per_mm;
  out.scatter_psd_m2_mm = differences.scatter_psd_m2_mm;

  std::size_t next = 0;
  for (MergedPass& pass : out.passes) {
    if (!pass.used) continue;
    describe_places(laid[next], spacing_m, pass);
    pass.on_merge = places_on_merge(laid[next]);
    pass.weight = mean.weight[next];
    if (!differences.coherence.empty()) pass.coherence = differences.coherence[next];
    if (!differences.noise_m2.empty()) pass.noise_rms_m = std::sqrt(differences.noise_m2[next]);
    if (!differences.stated_m2.empty()) pass.stated_noise_rms_m = std::sqrt(differences.stated_m2[next]);
    for (std::size_t i = 0; i < grid[next].known.size(); ++i)
      pass.texture_m.push_back(grid[next].known[i] != 0 ? grid[next].texture_m[i] : kNan);
    ++next;
  }

  Profile& profile = out.profile;
  profile.spacing_m = spacing_m;
  const std::size_t points = mean.texture_m.size();
  profile.texture_m = std::move(mean.texture_m);
  profile.force_N.assign(points, kNan);
  profile.speed_mps.assign(points, kNan);
  profile.sigma_m.assign(points, kNan);
  profile.texture_sigma_m.assign(points, kNan);
  const double scale_m = out.noise.scale_sigma * out.noise.texture_rms_m;
  for (std::size_t i = 0; i < points; ++i) {
    profile.s_m.push_back(spacing_m * static_cast<double>(i));
    profile.height_m.push_back(profile.texture_m[i] + mean.slow_m[i]);
    if (out.noise.added_sigma_m.empty() || !std::isfinite(profile.texture_m[i])) continue;
    const double sigma_m = std::hypot(out.noise.added_sigma_m[i], out.noise.misplaced_sigma_m[i], scale_m);
    profile.texture_sigma_m[i] = sigma_m;
    profile.sigma_m[i] = sigma_m;
  }
  return out;
}

}  // namespace asperity

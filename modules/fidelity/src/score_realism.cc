#include "asperity/fidelity/score_realism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/fidelity/estimate_hand.h"
#include "asperity/fidelity/stroke_signals.h"
#include "asperity/pipeline/merge_results.h"
#include "asperity/profile/lay_pass.h"
#include "asperity/signal/student.h"
#include "asperity/verdict/judge_realism.h"

namespace asperity {

namespace {

constexpr std::size_t kLeastSegments = 4;

// The two quantities of one stroke, on the grid of the held-back one.
struct Channels {
  std::vector<double> accel_mps2, force_N;
};

std::vector<double> at_speed(const StrokeSignals& stroke, std::span<const double> accel_mps2, double speed_mps) {
  std::vector<double> out(accel_mps2.begin(), accel_mps2.end());
  for (std::size_t i = 0; i < out.size(); ++i) {
    // Samples that slow are not usable.
    const double v = std::max(stroke.speed_mps[i], 0.1 * stroke.usual_mps);
    out[i] *= (speed_mps / v) * (speed_mps / v);
  }
  return out;
}

Channels channels_of(const StrokeSignals& stroke, std::span<const double> accel_mps2, std::span<const double> force_N,
                     const PathGrid& grid, double speed_mps) {
  return {over_path(stroke, at_speed(stroke, accel_mps2, speed_mps), grid), over_path(stroke, force_N, grid)};
}

std::vector<double> at_places(const std::vector<double>& x, std::span<const double> places) {
  std::vector<double> out;
  out.reserve(places.size());
  for (const double place : places) out.push_back(value_at(x, place));
  return out;
}

// nan within `margin_m` of the first and last value that is known.
void cut_ends(std::vector<double>& x, const PathGrid& grid, double margin_m) {
  std::size_t first = 0, last = x.size();
  while (first < last && !std::isfinite(x[first])) ++first;
  while (last > first && !std::isfinite(x[last - 1])) --last;
  const double points = margin_m / grid.spacing_m;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double at = static_cast<double>(i);
    if (at < static_cast<double>(first) + points || at + points >= static_cast<double>(last)) x[i] = kNan;
  }
}

// The relief at the points of the stroke, and how it lies there.
struct LaidRelief {
  PassAlignment alignment;
  std::vector<double> height_m;
};

LaidRelief lay_relief(const RenderedRelief& relief, const ProfilePass& stroke, const PathGrid& grid,
                      const RealismConfig& config) {
  ProfilePass pass;
  pass.name = relief.name;
  pass.spacing_m = relief.spacing_m;
  pass.texture_m = relief.height_m;
  LaidRelief out{align_passes(stroke, pass, config.align), {}};
  if (relief.is_laid) {
    const double ends_m = std::abs(out.alignment.stretch) * grid.spacing_m * static_cast<double>(grid.count);
    const bool near = !out.alignment.reversed && std::abs(out.alignment.shift_m) + ends_m <= config.max_place_error_m;
    out.alignment.agrees = out.alignment.agrees && near;
    if (!out.alignment.agrees) {
      out.height_m = relief.height_m;
      out.height_m.resize(grid.count, kNan);
      return out;
    }
  }
  out.height_m = at_places(relief.height_m, lay_pass(stroke, pass, out.alignment, config.align));
  return out;
}

double share_of(std::span<const double> tangential_N, std::span<const double> normal_N,
                const std::vector<char>& usable) {
  double tangential = 0.0, normal = 0.0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (usable[i] == 0 || !std::isfinite(tangential_N[i]) || !std::isfinite(normal_N[i])) continue;
    tangential += tangential_N[i];
    normal += normal_N[i];
  }
  return normal > 0.0 ? tangential / normal : kNan;
}

double share_score(double other, double real, double half_dB) {
  if (!std::isfinite(real) || !std::isfinite(other) || !(real > 0.0)) return kNan;
  return other > 0.0 ? std::exp2(-std::abs(20.0 * std::log10(other / real)) / half_dB) : 0.0;
}

// Of the surface's power over the noise's, in a band of the stroke's heights; infinite where nothing is stated.
double snr_in(const ProcessResult& result, const BandSignals& band) {
  const auto& noise = result.noise;
  double surface = 0.0, added = 0.0;
  const auto sum = [&](const std::vector<double>& f, const std::vector<double>& density) {
    double total = 0.0;
    for (std::size_t i = 1; i < f.size(); ++i) {
      const double at = 0.5 * (f[i] + f[i - 1]);
      if (at >= band.low_cycles_per_mm && at < band.high_cycles_per_mm)
        total += 0.5 * (density[i] + density[i - 1]) * (f[i] - f[i - 1]);
    }
    return total;
  };
  if (noise.added_psd_m2_mm.size() != noise.frequency_cycles_per_mm.size()) return kNan;
  surface = sum(result.spectrum.frequency_cycles_per_mm, result.spectrum.density_m2_mm);
  added = sum(noise.frequency_cycles_per_mm, noise.added_psd_m2_mm);
  return added > 0.0 ? surface / added : std::numeric_limits<double>::infinity();
}

struct Compared {
  CrossSpectra rendered;
  std::vector<CrossSpectra> others;
  std::vector<BandSignals> bands;
};

// The spectra of one quantity, and the bands in which it is compared.
Compared compare_channel(const std::vector<double>& real, const std::vector<double>& rendered,
                         const std::vector<std::vector<double>>& others, const PathGrid& grid,
                         double high_cycles_per_mm, const ProcessResult& stroke, const RealismConfig& config) {
  Compared out;
  out.rendered = cross_spectra(real, rendered, grid.spacing_m, config.segment_m);
  for (const std::vector<double>& other : others)
    out.others.push_back(cross_spectra(real, other, grid.spacing_m, config.segment_m));
  out.bands = third_octaves(out.rendered, config.align.low_cycles_per_mm, high_cycles_per_mm);
  for (BandSignals& band : out.bands) band.is_compared = true;
  const SignalAgreement all = agreement_of(out.rendered, out.bands, out.rendered.segments(), config.false_alarm);
  std::vector<double> coherence(out.bands.size(), 0.0), threshold(out.bands.size(), 0.0);
  for (const CrossSpectra& other : out.others) {
    const SignalAgreement pair = agreement_of(other, out.bands, other.segments(), config.false_alarm);
    for (std::size_t b = 0; b < out.bands.size(); ++b) {
      coherence[b] += pair.bands[b].coherence;
      threshold[b] += pair.bands[b].threshold;
    }
  }
  for (std::size_t b = 0; b < out.bands.size(); ++b) {
    BandSignals& band = out.bands[b];
    const bool agreed = out.others.empty() ? !(snr_in(stroke, band) < config.least_snr) : coherence[b] > threshold[b];
    band.is_compared = agreed && all.bands[b].real_rms >= config.least_part * all.real_rms;
  }
  return out;
}

// (q_acceleration q_force q_friction)^(1/2); a friction that is not measured counts as right.
double joint_score(double acceleration, double force, double friction) {
  return std::sqrt(acceleration * force * (std::isfinite(friction) ? friction : 1.0));
}

// A value and its 95 % interval by the jackknife: `value_without(i)`, one for each of `count` parts.
void jackknife(double value, std::size_t count, const std::function<double(std::size_t)>& value_without, double& low,
               double& high) {
  std::vector<double> without;
  for (std::size_t i = 0; i < count; ++i) {
    if (const double one = value_without(i); std::isfinite(one)) without.push_back(one);
  }
  const double n = static_cast<double>(without.size());
  if (n < 3.0 || !std::isfinite(value)) return;
  double mean = 0.0, square = 0.0;
  for (const double one : without) mean += one / n;
  for (const double one : without) square += (one - mean) * (one - mean);
  const double half = student_quantile(0.95, n - 1.0) * std::sqrt((n - 1.0) / n * square);
  low = std::clamp(value - half, 0.0, 1.0);
  high = std::clamp(value + half, 0.0, 1.0);
}

void summarise_channel(const Compared& compared, const RealismConfig& config, RealismChannel& out) {
  out.rendered = agreement_of(compared.rendered, compared.bands, compared.rendered.segments(), config.false_alarm);
  out.score = agreement_score(out.rendered, config.half_dB);
  if (compared.others.empty()) return;
  const double count = static_cast<double>(compared.others.size());
  out.ceiling_score = out.ceiling_correlation = out.ceiling_distance_dB = out.ceiling_level_dB = 0.0;
  for (const CrossSpectra& other : compared.others) {
    const SignalAgreement pair = agreement_of(other, compared.bands, other.segments(), config.false_alarm);
    out.ceiling_score += agreement_score(pair, config.half_dB) / count;
    out.ceiling_correlation += pair.correlation / count;
    out.ceiling_distance_dB += pair.distance_dB / count;
    out.ceiling_level_dB += pair.level_dB / count;
  }
}

}  // namespace

RealismScore score_realism(const RenderedRelief& relief, const RealStroke& stroke, std::span<const RealStroke> others,
                           const RealismConfig& config, const Observer& observer) {
  RealismScore out;
  const StrokeSignals real = measure_stroke(stroke.result, stroke.calibration, stroke.name);
  const PathGrid grid = grid_of(stroke.result.profile);
  const ProfilePass pass = pass_of_result(stroke.result, stroke.name);
  const auto high_of = [&](double rate_Hz) {
    return std::min(config.align.high_cycles_per_mm, 0.4 * rate_Hz / (1e3 * real.usual_mps));
  };
  const double low = config.align.low_cycles_per_mm;
  out.speed_mps = real.usual_mps;
  out.contact = relief.contact;
  out.stiffness_known = relief.stiffness_known;
  out.friction_known = relief.friction_known;
  out.no_places = relief.no_places;

  observer.update("placing", 0.0);
  const LaidRelief laid = lay_relief(relief, pass, grid, config);
  out.alignment = laid.alignment;

  observer.update("rendering", 0.3);
  out.hand = estimate_hand(real, grid, config.segment_m, low, high_of(real.force_rate_Hz), config.probe);
  const RenderedStroke rendered = render_stroke(real, grid, laid.height_m, relief.contact, out.hand, config.probe, low);
  std::vector<double> read_N = rendered.force_N;
  for (std::size_t i = 0; i < read_N.size(); ++i)
    if (!std::isfinite(real.force_N[i])) read_N[i] = kNan;

  observer.update("comparing", 0.6);
  Channels measured = channels_of(real, real.accel_mps2, real.force_N, grid, real.usual_mps);
  cut_ends(measured.accel_mps2, grid, config.margin_m);
  cut_ends(measured.force_N, grid, config.margin_m);
  Channels made = channels_of(real, rendered.accel_mps2, read_N, grid, real.usual_mps);
  for (std::size_t i = 0; i < grid.count; ++i)
    if (!std::isfinite(laid.height_m[i])) made.accel_mps2[i] = made.force_N[i] = kNan;
  std::vector<std::vector<double>> other_accel, other_force;
  double other_shares = 0.0;
  for (const RealStroke& one : others) {
    const StrokeSignals signals = measure_stroke(one.result, one.calibration, one.name);
    const PathGrid own = grid_of(one.result.profile);
    const ProfilePass other_pass = pass_of_result(one.result, one.name);
    OtherStroke& other = out.others.emplace_back();
    other.name = one.name;
    other.speed_mps = signals.usual_mps;
    other.alignment = align_passes(pass, other_pass, config.align);
    const std::vector<double> places = lay_pass(pass, other_pass, other.alignment, config.align);
    const Channels channels = channels_of(signals, signals.accel_mps2, signals.force_N, own, real.usual_mps);
    other_accel.push_back(at_places(channels.accel_mps2, places));
    other_force.push_back(at_places(channels.force_N, places));
    if (!signals.tangential_N.empty())
      other_shares += share_of(signals.tangential_N, signals.normal_N, signals.usable);
    else
      other_shares = kNan;
  }
  const Compared accel = compare_channel(measured.accel_mps2, made.accel_mps2, other_accel, grid, high_of(real.rate_Hz),
                                         stroke.result, config);
  const Compared force = compare_channel(measured.force_N, made.force_N, other_force, grid, high_of(real.force_rate_Hz),
                                         stroke.result, config);
  out.segments = std::min(accel.rendered.whole_segments(), force.rendered.whole_segments());
  out.compared_m = 0.5 * config.segment_m * static_cast<double>(out.segments + 1);
  if (out.segments < kLeastSegments) {
    throw Error(fmt::format("{}: the rendered surface and the stroke share {:.0f} mm; at least {:.0f} mm are needed",
                            stroke.name, out.segments == 0 ? 0.0 : 1e3 * out.compared_m,
                            0.5e3 * config.segment_m * static_cast<double>(kLeastSegments + 1)));
  }
  summarise_channel(accel, config, out.acceleration);
  summarise_channel(force, config, out.force);
  if (!real.tangential_N.empty()) {
    FrictionShare& f = out.friction;
    f.real = share_of(real.tangential_N, real.normal_N, real.usable);
    f.rendered = share_of(rendered.tangential_N, rendered.normal_N, real.usable);
    f.score = share_score(f.rendered, f.real, config.half_dB);
    if (!others.empty()) {
      f.other = other_shares / static_cast<double>(others.size());
      f.ceiling_score = share_score(f.other, f.real, config.half_dB);
    }
  }

  // The score with any segment left out; with the spectra of a stroke, or of the rendered surface.
  const auto score_without = [&](const CrossSpectra& a, const CrossSpectra& f, double friction, std::size_t i) {
    return joint_score(agreement_score(agreement_of(a, accel.bands, i, config.false_alarm), config.half_dB),
                       agreement_score(agreement_of(f, force.bands, i, config.false_alarm), config.half_dB), friction);
  };
  const std::size_t all = accel.rendered.segments();
  const auto rendered_without = [&](std::size_t i) {
    return score_without(accel.rendered, force.rendered, out.friction.score, i);
  };
  out.score = rendered_without(all);
  jackknife(out.score, all, rendered_without, out.low, out.high);
  if (!others.empty()) {
    const auto ceiling_without = [&](std::size_t i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < others.size(); ++k) {
        const double one = score_without(accel.others[k], force.others[k], out.friction.ceiling_score, i);
        if (i == all) out.others[k].score = one;
        sum += one / static_cast<double>(others.size());
      }
      return sum;
    };
    out.ceiling = ceiling_without(all);
    jackknife(out.ceiling, all, ceiling_without, out.ceiling_low, out.ceiling_high);
  }

  RealismEvidence evidence;
  evidence.score = out.score;
  evidence.ceiling = out.ceiling;
  evidence.min_score = config.min_score;
  evidence.is_placed = laid.alignment.agrees;
  evidence.no_places = relief.no_places;
  evidence.stiffness_known = relief.stiffness_known;
  evidence.is_own = relief.is_own;
  evidence.has_others = !others.empty();
  evidence.others_agree = std::any_of(out.others.begin(), out.others.end(),
                                      [](const OtherStroke& other) { return other.alignment.agrees; });
  out.verdicts = judge_realism(evidence);
  out.trustworthy = is_trustworthy(out.verdicts);
  return out;
}

}  // namespace asperity

#include "asperity/fidelity/check_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/nan.h"
#include "asperity/base/units.h"
#include "asperity/profile/resample_over_path.h"
#include "asperity/render/render_step.h"
#include "asperity/signal/statistics.h"
#include "asperity/texture/compare_textures.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/verdict/judge_rendering.h"

namespace asperity {

using Eigen::Vector3d;

namespace {

// What was real and what was rendered, one entry a tick in which the scan was in contact.
struct Ticks {
  std::vector<double> s_m, height_m, force_N, measured_N, texture_N_per_m;
  std::size_t all = 0, touching = 0;
  const Texture* texture = nullptr;  // that was touched most
};

// Why a texture cannot have the phase of a scan of this length, in words; empty if it can.
std::string why_no_phase(const Texture* texture, double path_m) {
  if (texture == nullptr) return "the scan is where the scene has no texture";
  if (is_synthetic(texture->model)) return "the texture is synthesised from a spectrum";
  const auto window = height_window(texture->model, std::numeric_limits<std::size_t>::max());
  if (!window) return "the texture has no heights of its own";
  const double length_m = window->length_m;
  return length_m > path_m ? "" : fmt::format("the texture repeats after {:.1f} mm", 1e3 * length_m);
}

Ticks render_scan(const PressedScan& pressed, const RenderModel& model, double rate_Hz, const Observer& observer) {
  Ticks out;
  ServoState state;
  std::map<std::int32_t, std::size_t> touched;
  const auto count =
      static_cast<std::int64_t>(std::floor(static_cast<double>(pressed.path.t_ns.back()) * kNanosecond_s * rate_Hz));
  std::size_t hint = 0;
  DeviceState device;
  device.dt_s = 1.0 / rate_Hz;
  device.p_world_m = pressed.path.p_world_m.front();
  for (std::int64_t i = 0; i <= count; ++i) {
    if (i % 4096 == 0) observer.update("rendering", static_cast<double>(i) / static_cast<double>(count + 1));
    const std::int64_t t_ns = std::llround(static_cast<double>(i) / rate_Hz / kNanosecond_s);
    const TimeIndex place = find_time(pressed.path.t_ns, t_ns, hint);
    const Vector3d p_m = position_at(pressed.path, t_ns, hint);
    device.v_world_mps = (p_m - device.p_world_m) * rate_Hz;
    device.p_world_m = p_m;
    const ServoOutput output = render_step(model, state, device);
    if (pressed.contact[place.index] == 0) continue;
    const std::size_t next = std::min(place.index + 1, pressed.path.size() - 1);
    const auto between = [&](const std::vector<double>& x) {
      return x[place.index] + place.share * (x[next] - x[place.index]);
    };
    const bool touching = output.contact.found();
    out.s_m.push_back(between(pressed.s_m));
    out.measured_N.push_back(between(pressed.force_N));
    out.texture_N_per_m.push_back(between(pressed.texture_N_per_m));
    out.height_m.push_back(touching ? output.texture_height_m : kNan);
    out.force_N.push_back(touching ? output.force_N.dot(pressed.n_world[place.index]) : kNan);
    ++out.all;
    if (!touching) continue;
    ++out.touching;
    const RenderObject& object = model.objects[output.contact.object];
    if (!object.texture.empty()) ++touched[object.texture[output.contact.triangle]];
  }
  const auto most = std::max_element(touched.begin(), touched.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most != touched.end() && most->first >= 0) {
    out.texture = &model.textures[static_cast<std::size_t>(most->first)].texture;
  }
  return out;
}

// A quantity of the ticks on the grid of the profile; nan where there is none.
std::vector<double> on_grid(const Ticks& ticks, const std::vector<double>& x, const Profile& profile,
                            double max_hole_m) {
  const std::span<const double> channel(x);
  const PathKnots knots = gather_knots(ticks.s_m, std::span(&channel, 1), {}, 0.25 * profile.spacing_m);
  const auto first = std::llround(profile.s_m.front() / profile.spacing_m);
  return resample_smooth(knots, first, profile.size(), profile.spacing_m, max_hole_m);
}

struct Pair {
  std::vector<double> real, rendered;
};

// Both with the gaps of both, from the first common value to the last.
Pair common(std::vector<double> real, std::vector<double> rendered) {
  std::size_t first = real.size(), last = 0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    if (std::isfinite(real[i]) && std::isfinite(rendered[i])) {
      first = std::min(first, i);
      last = i + 1;
    } else {
      real[i] = rendered[i] = kNan;
    }
  }
  if (first >= last) throw Error("score: the scan and its rendering have no position in common");
  const auto cut = [&](std::vector<double>& x) {
    x.erase(x.begin() + static_cast<std::ptrdiff_t>(last), x.end());
    x.erase(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(first));
  };
  cut(real);
  cut(rendered);
  return {std::move(real), std::move(rendered)};
}

SpectrumAgreement compare_spectra(const Pair& pair, double spacing_m, const CompareTexturesConfig& config) {
  const auto line = [&](const std::vector<double>& x) {
    return ComparedSurface{{band_limited_heights(x, spacing_m, config)}, spacing_m, {}, {}};
  };
  const ComparedSurface real = line(pair.real), rendered = line(pair.rendered);
  SpectrumAgreement out;
  out.real_rms = rms(real.lines_m.front());
  out.rendered_rms = rms(rendered.lines_m.front());
  out.rms_ratio = out.rendered_rms / out.real_rms;
  constexpr double kMost_dB = 40.0;
  double sum = 0.0;
  std::size_t compared = 0;
  for (const BandDifference& band : compare_textures(real, rendered, config).bands) {
    BandAgreement one{band.low_cycles_per_mm, band.high_cycles_per_mm, band.rms_m.a, band.rms_m.b, 0.0,
                      band.is_compared};
    if (one.real_rms != one.rendered_rms) {
      one.difference_dB = std::clamp(20.0 * std::log10(one.rendered_rms / one.real_rms), -kMost_dB, kMost_dB);
    }
    if (one.is_compared) {
      sum += one.difference_dB * one.difference_dB;
      ++compared;
    }
    out.bands.push_back(one);
  }
  if (compared > 0) out.distance_dB = std::sqrt(sum / static_cast<double>(compared));
  return out;
}

// The mean difference of the quantiles of both lines about their means, over the real RMS value.
double compare_distributions(const Pair& pair, double spacing_m, const CompareTexturesConfig& config) {
  std::vector<double> real = band_limited_heights(pair.real, spacing_m, config);
  std::vector<double> rendered = band_limited_heights(pair.rendered, spacing_m, config);
  const double spread = standard_deviation(real), offset = mean(real) - mean(rendered);
  std::sort(real.begin(), real.end());
  std::sort(rendered.begin(), rendered.end());
  double sum = 0.0;
  for (std::size_t i = 0; i < real.size(); ++i) sum += std::abs(rendered[i] + offset - real[i]);
  return sum / (static_cast<double>(real.size()) * spread);
}

// What the texture's spring makes of the real heights.
std::vector<double> expected_force(const Profile& profile, const std::vector<double>& texture_N_per_m) {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const double height_m : profile.height_m) {
    if (std::isfinite(height_m)) lowest_m = std::min(lowest_m, height_m);
  }
  std::vector<double> out = texture_N_per_m;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] *= profile.height_m[i] - lowest_m;
  return out;
}

// What is rendered beyond the measured force, which the press alone renders.
std::vector<double> added_force(std::vector<double> rendered_N, const std::vector<double>& measured_N) {
  for (std::size_t i = 0; i < rendered_N.size(); ++i) rendered_N[i] -= measured_N[i];
  return rendered_N;
}

void judge_score(RendererCheck& out, const RendererCheckConfig& config) {
  const auto agreement = [](double distance, double half) { return std::exp2(-distance / half); };
  const double ratio = out.height.rms_ratio;
  out.height_score = std::min(ratio, 1.0 / ratio) * agreement(out.height.distance_dB, config.half_dB);
  out.height_score *=
      out.phase_known ? std::max(out.correlation, 0.0) : agreement(out.distribution_distance, config.half_distribution);
  out.force_score = agreement(out.force.distance_dB, config.half_dB);
  for (double* score : {&out.height_score, &out.force_score}) {
    if (!std::isfinite(*score)) *score = 0.0;
  }
  out.score = out.height_score * out.force_score;
  const std::string what = out.phase_known
                               ? fmt::format("heights correlate by {:.3f}", out.correlation)
                               : fmt::format(
                                     "{}, so spectra and distributions alone are compared; the heights' are {:.2f} RMS "
                                     "heights apart",
                                     out.phase_unknown, out.distribution_distance);
  out.comparison = fmt::format(
      "{}, rendered ones are {:.2f} of the real; spectra of height are {:.1f} dB apart, of force "
      "{:.1f} dB",
      what, ratio, out.height.distance_dB, out.force.distance_dB);
  out.verdicts =
      judge_rendering({out.score, config.min_score, out.contact_fraction, config.min_contact_fraction, out.comparison});
  out.trustworthy = is_trustworthy(out.verdicts);
}

}  // namespace

RendererCheck check_renderer(const ProcessResult& measured, const PressedScan& pressed, const RenderModel& model,
                             double servo_Hz, const RendererCheckConfig& config, const Observer& observer) {
  const Profile& profile = measured.profile;
  if (profile.size() == 0 || pressed.path.size() == 0) throw Error("score: the scan has no profile");
  const Ticks ticks = render_scan(pressed, model, servo_Hz, observer);
  if (ticks.touching == 0) throw Error("score: the scan never touches the scene; is it registered to this mesh?");

  RendererCheck out;
  out.ticks = ticks.all;
  out.contact_fraction = static_cast<double>(ticks.touching) / static_cast<double>(ticks.all);
  out.speed_mps = measured.speed.mean_mps;
  const TipMotion& motion = measured.trajectory.motion;
  const double span_s = static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
  const double rate_Hz = std::min(servo_Hz, static_cast<double>(motion.size() - 1) / span_s);
  ComparisonConfig comparison = config.comparison;
  comparison.high_cycles_per_mm =
      std::min(comparison.high_cycles_per_mm, comparison_limit_cycles_per_mm(rate_Hz, out.speed_mps));
  out.low_cycles_per_mm = comparison.low_cycles_per_mm;
  out.high_cycles_per_mm = comparison.high_cycles_per_mm;

  const ProfileComparison heights =
      compare_profiles(ticks.s_m, ticks.height_m, profile.s_m, profile.height_m, comparison);
  out.correlation = heights.correlation;
  out.gain = heights.gain;
  out.shift_m = heights.shift_m;
  out.compared_m = heights.compared_m;
  out.phase_unknown = why_no_phase(ticks.texture, out.compared_m);
  out.phase_known = out.phase_unknown.empty();

  CompareTexturesConfig spectra;
  spectra.speed_mps = out.speed_mps;
  spectra.low_cycles_per_mm = out.low_cycles_per_mm;
  spectra.high_cycles_per_mm = out.high_cycles_per_mm;
  spectra.segment_mm = config.segment_mm;
  spectra.least_part = config.least_part;
  const auto grid = [&](const std::vector<double>& x) { return on_grid(ticks, x, profile, comparison.max_hole_m); };
  const Pair both = common(profile.height_m, grid(ticks.height_m));
  out.height = compare_spectra(both, profile.spacing_m, spectra);
  out.distribution_distance = compare_distributions(both, profile.spacing_m, spectra);
  const std::vector<double> measured_N = grid(ticks.measured_N), rendered_N = grid(ticks.force_N);
  const std::vector<double> expected_N = expected_force(profile, grid(ticks.texture_N_per_m));
  out.force = compare_spectra(common(expected_N, added_force(rendered_N, measured_N)), profile.spacing_m, spectra);
  out.measured_force = compare_spectra(common(measured_N, rendered_N), profile.spacing_m, spectra);
  judge_score(out, config);
  return out;
}

}  // namespace asperity

#include "judge_case.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>

#include "asperity/base/error.h"
#include "asperity/base/random.h"
#include "asperity/pipeline/process_methods.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/profile/measure_roughness.h"
#include "fft.h"
#include "find_unknown_pitch.h"
#include "noise_twin.h"
#include "pitch_by_chance.h"
#include "true_figures.h"

namespace bench {

namespace {

using asperity::ProcessResult;

constexpr double kCovered_sigmas = 1.959963985;  // of a normal distribution: 95 %

// What the product says of a figure.
struct Said {
  double value = kMissing, stderr_ = kMissing;
  double low = kMissing, high = kMissing;  // instead of a standard error
};

// A texture and what belongs to it.
struct TextureView {
  std::span<const double> texture_m;
  double spacing_m = 0.0;
  double pitch_m = kMissing;  // of the surface, as its maker knows it
};

struct FigureKind {
  const char* name;
  std::function<Said(const ProcessResult&)> said;
  // Of a texture; nullptr: `truth` instead.
  std::function<double(const TextureView&)> of_texture;
  std::function<double(const ScanCase&, const TrueProfile&)> truth;
  bool is_height = false;
  bool needs_pitch = false;  // of the maker: an oracle may or may not be told it
  // Of shape: what noise of a share 1 − `share` of the power has made of it is taken off (cumulants add).
  std::function<double(double value, double share)> without_noise = nullptr;
};

Said roughness(const ProcessResult& r, double asperity::RoughnessParameters::*value) {
  if (!r.roughness) return {};
  return {(*r.roughness).*value, r.roughness->standard_error.*value, kMissing, kMissing};
}

double plain(const TextureView& view, double PlainRoughness::*value) {
  return measure_plain_roughness(view.texture_m).*value;
}

double library(const TextureView& view, double asperity::RoughnessParameters::*value) {
  return asperity::measure_roughness(view.texture_m, view.spacing_m).*value;
}

double rms(std::span<const double> x) {
  double sum = 0.0, count = 0.0;
  for (const double v : x) {
    if (!std::isfinite(v)) continue;
    sum += v * v;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kMissing;
}

// A figure is a line here: what is said of it, and how the truth's is had.
const std::vector<FigureKind>& figure_kinds() {
  using R = asperity::RoughnessParameters;
  using P = PlainRoughness;
  static const std::vector<FigureKind> kKinds{
      {"length_m",
       [](const ProcessResult& r) {
         return Said{r.base.length_m, r.noise.length_stderr_m, kMissing, kMissing};
       },
       nullptr, [](const ScanCase&, const TrueProfile& t) { return t.length_m; }},
      {"pitch_m",
       [](const ProcessResult& r) {
         return r.periodicity.periodic ? Said{r.periodicity.pitch_m, r.periodicity.pitch_stderr_m, kMissing, kMissing}
                                       : Said{};
       },
       [](const TextureView& v) { return find_true_pitch_m(v.texture_m, v.spacing_m, v.pitch_m); }, nullptr, false,
       true},
      {"depth_m",
       [](const ProcessResult& r) {
         return r.periodicity.periodic ? Said{r.periodicity.depth_m, r.periodicity.depth_stderr_m, kMissing, kMissing}
                                       : Said{};
       },
       [](const TextureView& v) { return measure_depth_m(v.texture_m, v.spacing_m, v.pitch_m); }, nullptr, true, true},
      {"Ra_m", [](const ProcessResult& r) { return roughness(r, &R::Ra_m); },
       [](const TextureView& v) { return plain(v, &P::Ra_m); }, nullptr, true},
      {"Rq_m", [](const ProcessResult& r) { return roughness(r, &R::Rq_m); },
       [](const TextureView& v) { return plain(v, &P::Rq_m); }, nullptr, true},
      {"Rz_m", [](const ProcessResult& r) { return roughness(r, &R::Rz_m); },
       [](const TextureView& v) { return plain(v, &P::Rz_m); }, nullptr, true},
      {"Rt_m", [](const ProcessResult& r) { return roughness(r, &R::Rt_m); },
       [](const TextureView& v) { return plain(v, &P::Rt_m); }, nullptr, true},
      {"Rsk", [](const ProcessResult& r) { return roughness(r, &R::Rsk); },
       [](const TextureView& v) { return plain(v, &P::Rsk); }, nullptr, false, false,
       [](double value, double share) { return value / std::pow(share, 1.5); }},
      {"Rku", [](const ProcessResult& r) { return roughness(r, &R::Rku); },
       [](const TextureView& v) { return plain(v, &P::Rku); }, nullptr, false, false,
       [](double value, double share) { return 3.0 + (value - 3.0) / (share * share); }},
      {"RSm_m", [](const ProcessResult& r) { return roughness(r, &R::RSm_m); },
       [](const TextureView& v) { return library(v, &R::RSm_m); }, nullptr},
      {"R10z_m", [](const ProcessResult& r) { return roughness(r, &R::R10z_m); },
       [](const TextureView& v) { return library(v, &R::R10z_m); }, nullptr, true},
      {"Rcm50_m", [](const ProcessResult& r) { return roughness(r, &R::Rcm50_m); },
       [](const TextureView& v) { return library(v, &R::Rcm50_m); }, nullptr, true},
      {"noise_rms_m",
       [](const ProcessResult& r) {
         return Said{r.noise.noise_rms_m, r.noise.noise_rms_stderr_m, kMissing, kMissing};
       },
       nullptr, [](const ScanCase&, const TrueProfile& t) { return rms(t.placed_texture_error_m); }},
      // The compliance is what is measured: its interval is even, the stiffness's is not.
      {"compliance_mm_per_N",
       [](const ProcessResult& r) {
         return Said{r.stiffness.compliance_mm_per_N, r.stiffness.compliance_stderr_mm_per_N, kMissing, kMissing};
       },
       nullptr, [](const ScanCase& s, const TrueProfile&) { return 1.0 / s.stiffness_N_per_mm; }},
      {"stiffness_above_N_per_mm",
       [](const ProcessResult& r) {
         return Said{r.stiffness.lower_bound_N_per_mm, kMissing, r.stiffness.lower_bound_N_per_mm, kMissing};
       },
       nullptr, [](const ScanCase& s, const TrueProfile&) { return s.stiffness_N_per_mm; }},
  };
  return kKinds;
}

double standard_deviation(const std::vector<double>& x) {
  double sum = 0.0, square = 0.0;
  for (const double v : x) sum += v;
  for (const double v : x)
    square += (v - sum / static_cast<double>(x.size())) * (v - sum / static_cast<double>(x.size()));
  return std::sqrt(square / static_cast<double>(x.size() - 1));
}

constexpr double kSamePitch = 0.1;  // relative
constexpr int kTwins = 8;
constexpr std::uint64_t kTwinStream = 0x7477696e;

// Of a surface without a pattern: whether the oracle has one pitch in all twins nevertheless.
bool oracle_has_a_pitch(const ScanCase& scan, const TrueProfile& truth, double spacing_m) {
  asperity::Random random(scan.seed, kTwinStream);
  const NoiseTwin twin(truth.measured_error_m);
  double first_m = kMissing;
  for (int k = 0; k < kTwins; ++k) {
    std::vector<double> disturbed = twin.draw(random);
    for (std::size_t i = 0; i < disturbed.size(); ++i) disturbed[i] += truth.texture_m[i];
    const double pitch_m = find_unknown_pitch_m(disturbed, truth.measured_error_m, spacing_m);
    if (k == 0) first_m = pitch_m;
    if (!(std::abs(pitch_m / first_m - 1.0) < kSamePitch)) return false;
    if (!exceeds_random_surface(disturbed, spacing_m, pitch_m)) return false;
  }
  return true;
}

// The spread of the texture's figure over twins of the measured heights' actual error added to the truth: what one
// would have to live with who knew that error's spectrum, and took its bias off. Of a pattern's figures, one who is
// `told` the maker's pitch, or else looks for it in each twin (find_unknown_pitch.h); where that misses the pitch by
// more than a tenth in one of them, or a random surface may have it (pitch_by_chance.h), it is not determined. Of the
// shape, one who takes the noise's cumulants off, or `told` that the figure of the noisy heights is near the surface's,
// as it is where both are Gaussian.
double oracle_sigma(const FigureKind& kind, const ScanCase& scan, const TrueProfile& truth, double spacing_m,
                    bool told) {
  asperity::Random random(scan.seed, kTwinStream);
  const NoiseTwin twin(truth.measured_error_m);
  const double surface_m2 = std::pow(rms(truth.texture_m), 2), error_m2 = std::pow(rms(truth.measured_error_m), 2);
  std::vector<double> values;
  for (int k = 0; k < kTwins; ++k) {
    std::vector<double> disturbed = twin.draw(random);
    for (std::size_t i = 0; i < disturbed.size(); ++i) disturbed[i] += truth.texture_m[i];
    double pitch_m = scan.pitch_m;
    if (!told && kind.needs_pitch) {
      pitch_m = find_unknown_pitch_m(disturbed, truth.measured_error_m, spacing_m);
      if (!(std::abs(pitch_m / scan.pitch_m - 1.0) < kSamePitch)) return kMissing;
      if (!exceeds_random_surface(disturbed, spacing_m, pitch_m)) return kMissing;
    }
    try {
      double value = kind.of_texture({disturbed, spacing_m, pitch_m});
      if (!told && kind.without_noise) value = kind.without_noise(value, surface_m2 / (surface_m2 + error_m2));
      if (std::isfinite(value)) values.push_back(value);
    } catch (const asperity::Error&) {
      return kMissing;
    }
  }
  if (values.size() < kTwins) return kMissing;
  const double true_value = kind.of_texture({truth.texture_m, spacing_m, scan.pitch_m});
  const double bias = std::accumulate(values.begin(), values.end(), 0.0) / kTwins - true_value;
  const double spread = standard_deviation(values);
  return kind.is_height ? spread * std::max(1.0, 1.0 + bias / true_value) : std::hypot(spread, bias);
}

// The RMS of x in each band, by its periodogram; missing points count as 0.
std::array<double, kBands> band_rms(std::span<const double> x, double spacing_m) {
  std::size_t size = 1;
  while (size < x.size()) size <<= 1;
  std::vector<std::complex<double>> spectrum(size, 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) spectrum[i] = std::isfinite(x[i]) ? x[i] : 0.0;
  fft(spectrum, -1);
  std::array<double, kBands> out{};
  for (std::size_t k = 1; k < size / 2; ++k) {
    const double f = static_cast<double>(k) / (static_cast<double>(size) * 1e3 * spacing_m);
    const auto band = std::upper_bound(kBandEdges.begin(), kBandEdges.end(), f) - kBandEdges.begin() - 1;
    if (band < 0 || band >= static_cast<std::ptrdiff_t>(kBands)) continue;
    out[static_cast<std::size_t>(band)] +=
        2.0 * std::norm(spectrum[k]) / (static_cast<double>(size) * static_cast<double>(x.size()));
  }
  for (double& power : out) power = std::sqrt(power);
  return out;
}

// The same of what the product says of its noise.
std::array<double, kBands> said_band_rms(const asperity::TextureNoise& noise) {
  std::array<double, kBands> out{};
  const auto& f = noise.frequency_cycles_per_mm;
  for (std::size_t k = 1; k < f.size(); ++k) {
    const auto band = std::upper_bound(kBandEdges.begin(), kBandEdges.end(), f[k]) - kBandEdges.begin() - 1;
    if (band < 0 || band >= static_cast<std::ptrdiff_t>(kBands)) continue;
    const double density = (k < noise.added_psd_m2_mm.size() ? noise.added_psd_m2_mm[k] : 0.0) +
                           (k < noise.misplaced_psd_m2_mm.size() ? noise.misplaced_psd_m2_mm[k] : 0.0);
    out[static_cast<std::size_t>(band)] += density * (f[k] - f[k - 1]);
  }
  for (double& power : out) power = std::sqrt(power);
  return out;
}

FigureOutcome judge_figure(const FigureKind& kind, const ScanCase& scan, const ProcessResult* result,
                           const TrueProfile& truth) {
  FigureOutcome out;
  out.name = kind.name;
  if (result != nullptr && result->profile.size() > 0) {
    const Said said = kind.said(*result);
    out.value = said.value;
    out.low = std::isfinite(said.stderr_) ? said.value - kCovered_sigmas * said.stderr_ : said.low;
    out.high = std::isfinite(said.stderr_) ? said.value + kCovered_sigmas * said.stderr_ : said.high;
  }
  if (truth.texture_m.empty()) return out;
  try {
    out.truth = kind.of_texture ? kind.of_texture({truth.texture_m, result->profile.spacing_m, scan.pitch_m})
                                : kind.truth(scan, truth);
    // A tracker alone gives the length to a few per cent.
    if (out.name == "length_m") out.oracle_sigma = 0.0;
    if (kind.of_texture && std::isfinite(out.truth)) {
      out.oracle_sigma = oracle_sigma(kind, scan, truth, result->profile.spacing_m, false);
      if (kind.needs_pitch || kind.without_noise)
        out.told_sigma = oracle_sigma(kind, scan, truth, result->profile.spacing_m, true);
    }
  } catch (const asperity::Error&) {
    out.truth = kMissing;
  }
  return out;
}

}  // namespace

std::vector<std::string> figure_names() {
  std::vector<std::string> out;
  for (const FigureKind& kind : figure_kinds()) out.emplace_back(kind.name);
  return out;
}

ScanOutcome judge_case(const ScanCase& scan) {
  ScanOutcome out;
  out.seed = scan.seed;
  out.family = scan.family;
  out.probe = scan.probe;
  out.conditions = scan.conditions;
  out.nothing = scan.nothing;
  const auto begun = std::chrono::steady_clock::now();
  try {
    // The texture as it was measured is not in the result, where its noise is taken out.
    const asperity::ProcessConfig config;
    asperity::ProcessMethod method = asperity::ProcessMethods::get(config.method);
    std::vector<double> measured_m;
    method.make_profile = [&measured_m, make = method.make_profile](const auto&... stages) {
      asperity::Profile profile = make(stages...);
      measured_m = profile.texture_m;
      return profile;
    };
    const ProcessResult result = asperity::process_recording(scan.recording, config, method);
    out.process_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    out.trusted = result.trustworthy;
    for (const asperity::Verdict& verdict : result.verdicts) {
      if (verdict.severity == asperity::Severity::kNote) continue;
      out.codes += (out.codes.empty() ? "" : " ") +
                   std::string(asperity::kSeverityNames[static_cast<std::size_t>(verdict.severity)]) + ":" +
                   verdict.code;
    }
    out.noise_rms_m = result.noise.noise_rms_m;
    out.snr = result.noise.snr;
    out.snr_low = result.noise.snr_low;
    out.expected_correlation = result.noise.expected_correlation;
    out.stretch_correlation = result.noise.stretch_correlation;
    if (result.accuracy) {
      out.position_rms_m = result.accuracy->position_rms_m;
      if (result.accuracy->profile) out.correlation = result.accuracy->profile->correlation;
    }
    const TrueProfile truth = find_true_profile(scan.recording, result, measured_m);
    out.has_pattern = std::isfinite(scan.pitch_m);
    out.pattern_said = result.periodicity.periodic;
    out.oracle_pattern =
        !out.has_pattern && !truth.texture_m.empty() && oracle_has_a_pitch(scan, truth, result.profile.spacing_m);
    out.position_over_sigma = position_error_over_sigma(scan.recording, result.trajectory.motion);
    out.height_over_sigma = error_over_sigma(truth.error_m, result.profile.sigma_m);
    out.texture_over_sigma = error_over_sigma(truth.placed_texture_error_m, result.profile.texture_sigma_m.empty()
                                                                                ? result.profile.sigma_m
                                                                                : result.profile.texture_sigma_m);
    out.texture_error_m = rms(truth.placed_texture_error_m);
    out.texture_rms_m = rms(truth.texture_m);
    out.error_m = band_rms(truth.texture_error_m, result.profile.spacing_m);
    out.surface_m = band_rms(truth.texture_m, result.profile.spacing_m);
    out.said_m = said_band_rms(result.noise);
    for (const FigureKind& kind : figure_kinds()) out.figures.push_back(judge_figure(kind, scan, &result, truth));
  } catch (const asperity::Error& error) {
    out.failed = true;
    out.codes = std::string("failed: ") + error.what();
    for (const FigureKind& kind : figure_kinds()) out.figures.push_back(judge_figure(kind, scan, nullptr, {}));
  }
  return out;
}

}  // namespace bench

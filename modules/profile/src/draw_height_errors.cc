#include "draw_height_errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "asperity/base/random.h"
#include "asperity/profile/extract_texture.h"
#include "asperity/profile/height_error_density.h"
#include "draw_noise.h"

namespace asperity {

namespace {

constexpr std::size_t kFewestErrorDraws = 6;
constexpr std::size_t kMostDrawn = 2'000'000;  // numbers in all: a long profile's noise varies little between draws
constexpr double kStep_s = 1e-3;               // of the noise: beyond 500 Hz no height has any
constexpr double kMostStep_share = 1e-5;       // of the duration, for recordings of hours
constexpr double kSlowest_periods = 0.25;      // over the duration: what is slower is a straight line
constexpr std::size_t kWaves = 256;
constexpr std::uint64_t kErrorSeed = 20'260'301;
constexpr std::uint64_t kLeanSeed = 20'260'302;

// When each point was passed, s after the first.
std::vector<double> passing_times(const Profile& profile) {
  std::vector<double> out(profile.size(), 0.0);
  double speed_mps = 0.0;
  for (const double v : profile.speed_mps) {
    if (std::abs(v) > 0.0) speed_mps = std::abs(v);
    if (speed_mps > 0.0) break;
  }
  if (!(speed_mps > 0.0)) return {};
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (std::abs(profile.speed_mps[i]) > 0.0) speed_mps = std::abs(profile.speed_mps[i]);
    out[i] = out[i - 1] + profile.spacing_m / speed_mps;
  }
  return out;
}

// A density over time, at frequencies that are even in the logarithm.
struct Density {
  std::vector<double> frequency_Hz, density_m2ps;
  double step_s = kStep_s;
  std::size_t count = 0;  // numbers of one draw
};

Density density_over(const HeightErrors& errors, double duration_s) {
  Density out;
  out.step_s = std::max(kStep_s, kMostStep_share * duration_s);
  out.count = static_cast<std::size_t>(std::ceil(duration_s / out.step_s)) + 2;
  // A draw of a longer time has the waves that are slower than the profile.
  const double lowest_Hz = kSlowest_periods / duration_s, highest_Hz = 0.5 / out.step_s;
  for (std::size_t i = 0; i < kWaves; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(kWaves - 1);
    out.frequency_Hz.push_back(lowest_Hz * std::pow(highest_Hz / lowest_Hz, share));
    out.density_m2ps.push_back(height_error_density_m2ps(errors, out.frequency_Hz.back()));
  }
  return out;
}

// Draws of one density, read at the times. A drawn noise is 1/kSlowest_periods times as long as the profile; each of
// its parts is a draw of its own: they have only the waves that are slower than the profile in common.
class NoiseDraws {
 public:
  NoiseDraws(const Density& density, const std::vector<double>& t_s, Random& random)
      : density_(density), t_s_(t_s), random_(random) {}

  std::vector<double> next() {
    if (part_ == kParts) {
      noise_ =
          draw_noise(density_.frequency_Hz, density_.density_m2ps, kParts * density_.count, density_.step_s, random_);
      part_ = 0;
    }
    const double* noise = noise_.data() + part_++ * density_.count;
    std::vector<double> out(t_s_.size());
    for (std::size_t i = 0; i < t_s_.size(); ++i) {
      const double place = t_s_[i] / density_.step_s;
      const auto k = static_cast<std::size_t>(place);
      const double share = place - static_cast<double>(k);
      out[i] = (1.0 - share) * noise[k] + share * noise[k + 1];
    }
    return out;
  }

 private:
  static constexpr std::size_t kParts = 4;
  static_assert(kSlowest_periods * kParts == 1.0);

  const Density& density_;
  const std::vector<double>& t_s_;
  Random& random_;
  std::vector<double> noise_;
  std::size_t part_ = kParts;
};

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

void subtract(const std::vector<double>& from, double share, std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= share * from[i];
}

// Orthonormal polynomials up to `degree` over the points of `like` that have a height.
std::vector<std::vector<double>> orthonormal_polynomials(const std::vector<double>& like, int degree) {
  std::vector<std::vector<double>> terms;
  for (int d = 0; d <= degree; ++d) {
    std::vector<double> term(like.size());
    for (std::size_t i = 0; i < like.size(); ++i) {
      const double x = 2.0 * static_cast<double>(i) / static_cast<double>(like.size()) - 1.0;
      term[i] = std::isfinite(like[i]) ? std::pow(x, d) : 0.0;
    }
    for (const std::vector<double>& before : terms) subtract(before, product(before, term), term);
    const double norm = std::sqrt(product(term, term));
    if (!(norm > 1e-9)) continue;
    for (double& value : term) value /= norm;
    terms.push_back(std::move(term));
  }
  return terms;
}

void clear_gaps(const std::vector<double>& like, std::vector<double>& y) {
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (!std::isfinite(like[i]) || !std::isfinite(y[i])) y[i] = 0.0;
  }
}

// The points between parts of the profile that a long rest separates (make_profile.h): single ones without a height.
std::vector<std::size_t> find_seams(const Profile& profile, const std::vector<double>& t_s, double max_stop_s) {
  constexpr std::size_t kRestReach = 5;  // points over which the rest's time is spread
  std::vector<std::size_t> out;
  for (std::size_t i = 1; i + 1 < profile.size(); ++i) {
    if (std::isfinite(profile.height_m[i]) || !std::isfinite(profile.height_m[i - 1]) ||
        !std::isfinite(profile.height_m[i + 1])) {
      continue;
    }
    const std::size_t a = i < kRestReach ? 0 : i - kRestReach, b = std::min(i + kRestReach, profile.size() - 1);
    if (t_s[b] - t_s[a] > max_stop_s) out.push_back(i);
  }
  return out;
}

// What the surface shows, read `moved_m` further on, less what it is.
std::vector<double> misplace(std::span<const double> surface_m, const std::vector<double>& moved_m, double spacing_m) {
  std::vector<double> out(surface_m.size(), 0.0);
  const auto last = static_cast<double>(surface_m.size() - 1);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double place = std::clamp(static_cast<double>(i) + moved_m[i] / spacing_m, 0.0, last);
    const auto k = std::min(static_cast<std::size_t>(place), surface_m.size() - 2);
    const double share = place - static_cast<double>(k);
    out[i] = (1.0 - share) * surface_m[k] + share * surface_m[k + 1] - surface_m[i];
  }
  return out;
}

// One number a draw, normal, with a mean square of 1.
std::vector<double> draw_sizes(std::size_t count) {
  Random random(kLeanSeed);
  std::vector<double> out(count);
  double square = 0.0;
  for (double& x : out) {
    x = random.normal();
    square += x * x / static_cast<double>(count);
  }
  for (double& x : out) x /= std::sqrt(square);
  return out;
}

// Only the part of the density that comes from the normals' lean.
Density leaning_over(const HeightErrors& errors, const Density& rest, double duration_s) {
  Density out = density_over(errors, duration_s);
  for (std::size_t i = 0; i < out.density_m2ps.size(); ++i)
    out.density_m2ps[i] = std::max(0.0, out.density_m2ps[i] - rest.density_m2ps[i]);
  return out;
}

HeightErrors errors_along(const HeightErrors& errors) {
  HeightErrors out;
  out.accel_psd_m2ps3 = errors.along_accel_psd_m2ps3;
  out.tracker_psd_m2ps = errors.along_tracker_psd_m2ps;
  out.accel_corner_Hz = errors.accel_corner_Hz;
  out.accel_walk_psd_m2ps5 = errors.accel_walk_psd_m2ps5;
  out.tracker_slow_sigma_m = errors.tracker_slow_sigma_m;
  out.tracker_slow_time_s = errors.tracker_slow_time_s;
  out.object = errors.along_object;
  out.object_slow_time_s = errors.object_slow_time_s;
  return out;
}

}  // namespace

DrawnErrors draw_height_errors(const Profile& profile, const HeightErrors& errors, double cutoff_cycles_per_mm,
                               const TextureNoiseConfig& config, std::span<const double> surface_m) {
  DrawnErrors out;
  const std::vector<double> t_s = passing_times(profile);
  if (t_s.size() < 2) return out;
  HeightErrors upright = errors;
  upright.leaning_m2ps.clear();
  const Density height = density_over(upright, t_s.back()), along = density_over(errors_along(errors), t_s.back());
  const std::vector<std::size_t> seams = find_seams(profile, t_s, config.max_stop_s);
  const std::size_t draws = std::clamp(kMostDrawn / std::max(height.count, profile.size()), kFewestErrorDraws,
                                       std::max(config.draws, kFewestErrorDraws));
  const bool leans = !errors.leaning_m2ps.empty();
  const Density leaning = leans ? leaning_over(errors, height, t_s.back()) : Density{};
  const std::vector<double> lean = draw_sizes(draws);
  Random random(kErrorSeed);
  NoiseDraws heights(height, t_s, random), places(along, t_s, random), leanings(leaning, t_s, random);
  const std::vector<std::vector<double>> base = orthonormal_polynomials(profile.height_m, errors.base_degree);
  double shape = 0.0;
  std::vector<std::vector<double>> all_moved_m;
  for (std::size_t j = 0; j < draws; ++j) {
    std::vector<double> error_m = heights.next();
    if (leans) {
      const std::vector<double> leant_m = leanings.next();
      for (std::size_t i = 0; i < error_m.size(); ++i) error_m[i] += lean[j] * leant_m[i];
    }
    for (std::size_t i = 0; i < error_m.size(); ++i) {
      if (!std::isfinite(profile.height_m[i])) error_m[i] = profile.height_m[i];
    }
    std::vector<double> added_m =
        extract_texture(error_m, profile.spacing_m, cutoff_cycles_per_mm, config.bridge_m, seams);
    clear_gaps(profile.height_m, error_m);
    for (const std::vector<double>& term : base) subtract(term, product(term, error_m), error_m);
    clear_gaps(profile.texture_m, added_m);
    out.height_m.push_back(std::move(error_m));
    out.added_m.push_back(std::move(added_m));

    // The arc length's scale is no noise of the texture: it stretches all of it, and is in the errors of length and
    // pitch.
    std::vector<double> moved_m = places.next();
    double middle_m = 0.0;
    for (std::size_t i = 0; i < moved_m.size(); ++i) {
      middle_m += moved_m[i] / static_cast<double>(moved_m.size());
    }
    for (double& moved : moved_m) {
      moved -= middle_m;
      shape += moved * moved / static_cast<double>(draws * moved_m.size());
    }
    all_moved_m.push_back(std::move(moved_m));
  }
  // The acceleration along the path is full of impacts that are no noise: the smoother, which follows them, knows a
  // place better than that floor says.
  const double most_m2 = errors.along_sigma_m * errors.along_sigma_m;
  const double share = most_m2 > 0.0 && shape > most_m2 ? std::sqrt(most_m2 / shape) : 1.0;
  for (std::vector<double>& moved_m : all_moved_m) {
    for (double& moved : moved_m) moved *= share;
    out.misplaced_m.push_back(misplace(surface_m, moved_m, profile.spacing_m));
  }
  out.shape_variance_m2 = share * share * shape;
  return out;
}

}  // namespace asperity

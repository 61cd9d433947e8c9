#include "plane_waves.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include <Eigen/Dense>

#include "asperity/base/nan.h"
#include "asperity/signal/statistics.h"
#include "local_density.h"
#include "spectrum_at.h"

namespace asperity {

namespace {

constexpr double kPointsOfShortestWave = 4.0;
constexpr double kWaveTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kPathParts = 24;  // whose direction the noise is asked for
constexpr int kNearestWave = 2, kFarthestWave = 16;

// Means of `group` values; nan where none is finite.
std::vector<double> grouped(std::span<const double> x, std::size_t group) {
  std::vector<double> out;
  for (std::size_t from = 0; from + group <= x.size(); from += group) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = from; i < from + group; ++i) {
      if (!std::isfinite(x[i])) continue;
      sum += x[i];
      count += 1.0;
    }
    out.push_back(count > 0.0 ? sum / count : kNan);
  }
  return out;
}

}  // namespace

PlaneWaves::PlaneWaves(const BentPath& path, std::span<const double> height_m, double spacing_m,
                       const TextureNoise& noise, double most_noise, double shortest_m)
    : most_noise_(most_noise), noise_(noise) {
  const auto group = std::max<std::size_t>(1, static_cast<std::size_t>(shortest_m / kPointsOfShortestWave / spacing_m));
  height_m_ = grouped(path.straightened(height_m, 0.0), group);
  y_m_ = grouped(path.straightened(path.left_m(), 0.0), group);
  step_m_ = path.chord_m() / static_cast<double>(height_m.size() - 1) * static_cast<double>(group);
  double sum = 0.0;
  for (const double h : height_m_) {
    present_.push_back(std::isfinite(h) ? 1 : 0);
    if (!std::isfinite(h)) continue;
    sum += h;
    points_ += 1.0;
  }
  if (points_ == 0.0) return;
  for (std::size_t k = 0; k < height_m_.size(); ++k) {
    height_m_[k] = present_[k] != 0 ? height_m_[k] - sum / points_ : 0.0;
    mean_square_m2_ += height_m_[k] * height_m_[k] / points_;
  }
  for (std::size_t part = 0; part < kPathParts; ++part) {
    const std::size_t from = part * (y_m_.size() - 1) / kPathParts, to = (part + 1) * (y_m_.size() - 1) / kPathParts;
    if (to > from)
      direction_.push_back(
          Eigen::Vector2d(step_m_ * static_cast<double>(to - from), y_m_[to] - y_m_[from]).normalized());
  }
}

double PlaneWaves::power_at(std::span<const double> height_m, const Eigen::Vector2d& wave_per_m) const {
  std::complex<double> sum = 0.0;
  for (std::size_t k = 0; k < height_m.size(); ++k) {
    if (height_m[k] == 0.0) continue;
    sum += height_m[k] *
           std::polar(1.0, -kWaveTurn * (wave_per_m.x() * step_m_ * static_cast<double>(k) + wave_per_m.y() * y_m_[k]));
  }
  return 2e3 * step_m_ * std::norm(sum) / points_;
}

double PlaneWaves::phase_variance(const Eigen::Vector2d& wave_per_m) const {
  double one = 0.0, two = 0.0;
  for (std::size_t k = 0; k < y_m_.size(); ++k) {
    const double cycles = wave_per_m.x() * step_m_ * static_cast<double>(k) + wave_per_m.y() * y_m_[k];
    one += cycles;
    two += cycles * cycles;
  }
  const auto n = static_cast<double>(y_m_.size());
  return two / n - (one / n) * (one / n);
}

double PlaneWaves::noise_at(const Eigen::Vector2d& wave_per_m) const {
  double sum = 0.0;
  for (const Eigen::Vector2d& direction : direction_)
    sum +=
        spectrum_at(noise_.frequency_cycles_per_mm, noise_.added_psd_m2_mm, 1e-3 * std::abs(wave_per_m.dot(direction)));
  return direction_.empty() ? 0.0 : most_noise_ * sum / static_cast<double>(direction_.size());
}

PlaneWaves::Beside PlaneWaves::density_beside(const Eigen::Vector2d& wave_per_m, int nearest, int farthest, bool sides,
                                              std::span<const double> rest_m) const {
  const double apart_per_m = 1.0 / (step_m_ * static_cast<double>(size()));
  std::vector<double> offset, beside, below, above;
  for (int j = -farthest; j <= farthest; ++j) {
    if (std::abs(j) < nearest) continue;
    offset.push_back(j);
    beside.push_back(power_at(rest_m, {wave_per_m.x() + j * apart_per_m, wave_per_m.y()}));
    (j < 0 ? below : above).push_back(beside.back());
  }
  const LocalDensity fit = fit_local_density(offset, beside);
  Beside out{fit.density, fit.variance};
  if (fit.used == 0) return {0.0, 1.0};
  for (const std::vector<double>& side : {below, above}) {
    if (sides) out.density = std::max(out.density, median(side) / std::numbers::ln2);
  }
  return out;
}

PlaneWaves::Standing PlaneWaves::standing_of(std::span<const Eigen::Vector2d> waves_per_m) const {
  Standing out;
  std::vector<std::pair<double, Eigen::Vector2d>> waves;
  for (const Eigen::Vector2d& g : waves_per_m) waves.emplace_back(power_at(g), g);
  std::sort(waves.begin(), waves.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  const auto count = static_cast<Eigen::Index>(waves.size()), n = static_cast<Eigen::Index>(points_);
  if (n < 4 * count + 2) return out;
  Eigen::MatrixXd columns(n, 2 * count);
  Eigen::VectorXd heights(n);
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    if (present_[k] == 0) continue;
    for (Eigen::Index w = 0; w < count; ++w) {
      const Eigen::Vector2d& g = waves[static_cast<std::size_t>(w)].second;
      const double angle = kWaveTurn * (g.x() * step_m_ * static_cast<double>(k) + g.y() * y_m_[k]);
      columns(row, 2 * w) = std::cos(angle);
      columns(row, 2 * w + 1) = std::sin(angle);
    }
    heights[row++] = height_m_[k];
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(columns);
  const Eigen::VectorXd turned = qr.householderQ().transpose() * heights;
  Eigen::VectorXd rest = turned;
  rest.head(2 * count).setZero();
  rest = qr.householderQ() * rest;
  out.power_share = turned.head(2 * count).squaredNorm() / heights.squaredNorm();
  std::vector<double> rest_m(size(), 0.0);
  row = 0;
  for (std::size_t k = 0; k < size(); ++k) {
    if (present_[k] != 0) rest_m[k] = rest[row++];
  }
  for (Eigen::Index w = 0; w < count; ++w) {
    const Eigen::Vector2d& g = waves[static_cast<std::size_t>(w)].second;
    // A wave alone has columns of the square n/2.
    const double power = 1e3 * step_m_ * turned.segment(2 * w, 2).squaredNorm(), noise = noise_at(g);
    const auto rarity = [&](const Beside& beside) {
      if (!(beside.density > 0.0)) return 0.0;
      const double q = std::log1p(beside.variance * power / beside.density) / beside.variance;
      return noise > 0.0 ? std::min(q, power / noise) : q;
    };
    const Beside broad = density_beside(g, kNearestWave, kFarthestWave, true, rest_m);
    const double periods = g.norm() * step_m_ * static_cast<double>(size());
    const int nearest = periods < 50.0 ? 1 : periods < 100.0 ? 2 : 3;
    const int farthest = static_cast<int>(std::clamp(std::round(0.16 * periods), 5.0, 16.0));
    out.rarity.push_back(rarity(broad));
    out.narrow_rarity += rarity(density_beside(g, nearest, farthest, false, rest_m));
    out.ratio.push_back(broad.density > 0.0 ? power / std::max(broad.density, noise) : 0.0);
    out.information += 2.0 * out.ratio.back() * phase_variance(g);
  }
  return out;
}

}  // namespace asperity

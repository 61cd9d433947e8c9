#include "find_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "asperity/signal/spectrum.h"
#include "plane_waves.h"

namespace asperity {

namespace {

constexpr std::size_t kLatticePadding = 4;                         // bins to an independent frequency, at least
constexpr std::size_t kNearestInTable = 2, kFarthestInTable = 16;  // independent frequencies beside a wave
constexpr double kTableVariance = 1.0 / 24.0;                      // of the table's background, about
constexpr std::size_t kLatticeCandidates = 3;
constexpr double kLeastLatticeShare = 1.0 / 8.0;  // of the surface's power
constexpr double kOthersByChance = 0.01;          // of the waves beside the strongest
constexpr double kPlacesOfOthers = 8.0;           // that the strongest leaves open
constexpr double kTrialsOfPeak = 32.0;            // as LineSearch asks of a narrow peak
constexpr double kFewestRows = 8.0;               // across the chord: of fewer, 16 neighbours are beyond the band
constexpr double kFinestStep = 1e-2;              // of an independent frequency
constexpr double kMostPlaces = 33'554'432.0;      // 2^25: ordinates of the table and places of b, some seconds

// The lattice's waves by their orders.
constexpr std::array<std::array<int, 2>, 4> kLatticeOrders{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
constexpr double kMeanSquareOrder = 1.5;  // of m² + n²

std::array<Eigen::Vector2d, kLatticeOrders.size()> lattice_waves(const Eigen::Vector2d& b) {
  const Eigen::Vector2d across(-b.y(), b.x());
  std::array<Eigen::Vector2d, kLatticeOrders.size()> out;
  for (std::size_t w = 0; w < out.size(); ++w)
    out[w] = static_cast<double>(kLatticeOrders[w][0]) * b + static_cast<double>(kLatticeOrders[w][1]) * across;
  return out;
}

// exp(−T) Σ T^i/i! for i < k: of a sum of k exponential variables.
double tail_of_sum(std::size_t k, double total) {
  double term = 1.0, sum = 0.0;
  for (std::size_t i = 0; i < k; ++i) {
    sum += term;
    term *= total / static_cast<double>(i + 1);
  }
  return std::exp(-total) * sum;
}

// The probability that the highest of the field exceeds `total` (find_lattice.h): `area` and `border` of the search in
// units of the field's own slope.
double chance_of_highest(double total, double area, double border) {
  constexpr double kFreedom = 2.0 * kLatticeOrders.size();
  const double u = 2.0 * total;
  const double scale = std::exp(-total) / std::exp2(0.5 * (kFreedom - 2.0)) / std::tgamma(0.5 * kFreedom);
  const double one = scale * std::pow(u, 0.5 * (kFreedom - 1.0)) / std::sqrt(2.0 * std::numbers::pi);
  const double two = scale * std::pow(u, 0.5 * (kFreedom - 2.0)) * (u - kFreedom + 1.0) / (2.0 * std::numbers::pi);
  return tail_of_sum(kLatticeOrders.size(), total) + border * one + area * std::max(0.0, two);
}

// The rarity of the ordinates on a grid of wave vectors, coarsely: rows along the chord.
class RarityTable {
 public:
  RarityTable(const PlaneWaves& waves, double shortest_m) : step_m_(waves.step_m()) {
    const auto [low, high] = std::minmax_element(waves.y_m().begin(), waves.y_m().end());
    row_per_m_ = 1.0 / (static_cast<double>(kLatticePadding) * (*high - *low));
    while (size_ < kLatticePadding * waves.size()) size_ *= 2;
    bin_per_m_ = 1.0 / (step_m_ * static_cast<double>(size_));
    half_ = std::min(size_ / 2, static_cast<std::size_t>(1.0 / shortest_m / bin_per_m_) + 1);
    const auto rows = static_cast<std::size_t>(1.0 / shortest_m / row_per_m_) + 1;
    for (std::size_t row = 0; row <= rows; ++row) rows_.push_back(rarities(waves, static_cast<double>(row)));
  }

  double at(Eigen::Vector2d wave_per_m) const {
    if (wave_per_m.y() < 0.0) wave_per_m = -wave_per_m;
    const auto row = static_cast<std::size_t>(std::lround(wave_per_m.y() / row_per_m_));
    const auto bin = std::lround(wave_per_m.x() / bin_per_m_);
    if (row >= rows_.size() || static_cast<std::size_t>(std::abs(bin)) > half_) return 0.0;
    return rows_[row][static_cast<std::size_t>(bin + static_cast<long>(half_))];
  }

 private:
  // Of a row, from the wave −half_ to half_ along the chord.
  std::vector<float> rarities(const PlaneWaves& waves, double row) const {
    std::vector<double> real(size_, 0.0), imaginary(size_, 0.0);
    for (std::size_t k = 0; k < waves.size(); ++k) {
      const std::complex<double> phase = std::polar(1.0, -2.0 * std::numbers::pi * row * row_per_m_ * waves.y_m()[k]);
      real[k] = waves.heights_m()[k] * phase.real();
      imaginary[k] = waves.heights_m()[k] * phase.imag();
    }
    const std::vector<std::complex<double>> a = real_dft(real), b = real_dft(imaginary);
    const double unit = 2e3 * step_m_ / waves.points();
    std::vector<double> power(2 * half_ + 1);
    const std::complex<double> i(0.0, 1.0);
    for (std::size_t k = 0; k <= half_; ++k) {
      power[half_ + k] = unit * std::norm(a[k] + i * b[k]);
      power[half_ - k] = unit * std::norm(std::conj(a[k]) + i * std::conj(b[k]));
    }
    std::vector<double> sums(power.size() + 1, 0.0);
    for (std::size_t k = 0; k < power.size(); ++k) sums[k + 1] = sums[k] + power[k];
    const double each = static_cast<double>(size_) / static_cast<double>(waves.size());
    const auto near = static_cast<std::size_t>(each * kNearestInTable),
               far = static_cast<std::size_t>(each * kFarthestInTable);
    std::vector<float> out(power.size(), 0.0f);
    for (std::size_t k = 0; k < power.size(); ++k) {
      const std::size_t from = k > far ? k - far : 0, before = k > near ? k - near : 0;
      const std::size_t after = std::min(k + near + 1, power.size()), to = std::min(k + far + 1, power.size());
      const double count = static_cast<double>(before - from + to - after);
      if (!(count > 0.0)) continue;
      const double density = (sums[before] - sums[from] + sums[to] - sums[after]) / count;
      if (density > 0.0) out[k] = static_cast<float>(std::log1p(kTableVariance * power[k] / density) / kTableVariance);
    }
    return out;
  }

  double step_m_ = 0.0, row_per_m_ = 0.0, bin_per_m_ = 0.0;
  std::size_t size_ = 1, half_ = 0;
  std::vector<std::vector<float>> rows_;
};

struct Candidate {
  Eigen::Vector2d wave_per_m;
  double total;
};

// The highest sums of the table, no two within two independent frequencies of each other.
std::vector<Candidate> find_candidates(const RarityTable& table, double step_per_m, double lowest_per_m,
                                       double highest_per_m) {
  const auto last = static_cast<int>(highest_per_m / step_per_m);
  std::vector<Candidate> best;
  for (int a = 1; a <= last; ++a) {
    for (int c = -a + 1; c <= a; ++c) {
      const Eigen::Vector2d b = step_per_m * Eigen::Vector2d(a, c);
      if (b.norm() < lowest_per_m || b.norm() > highest_per_m) continue;
      double total = 0.0;
      for (const Eigen::Vector2d& wave : lattice_waves(b)) total += table.at(wave);
      if (!(total > 0.0) || (best.size() == kLatticeCandidates && total <= best.back().total)) continue;
      const auto near = std::find_if(best.begin(), best.end(), [&](const Candidate& other) {
        return (other.wave_per_m - b).norm() < 2.0 * static_cast<double>(kLatticePadding) * step_per_m;
      });
      if (near != best.end()) {
        if (near->total < total) *near = {b, total};
      } else {
        best.push_back({b, total});
      }
      std::sort(best.begin(), best.end(), [](const Candidate& x, const Candidate& y) { return x.total > y.total; });
      if (best.size() > kLatticeCandidates) best.pop_back();
    }
  }
  return best;
}

// The wave vector near `b` at which the lattice's waves, each over what it has at `b`, hold most power.
Eigen::Vector2d refined(const PlaneWaves& waves, const RarityTable& table, Eigen::Vector2d b, double step_per_m) {
  std::array<double, kLatticeOrders.size()> weight{};
  const auto first = lattice_waves(b);
  for (std::size_t w = 0; w < weight.size(); ++w) {
    const double power = waves.power_at(first[w]);
    weight[w] = power > 0.0 ? table.at(first[w]) / power : 0.0;
  }
  const auto power_at = [&](const Eigen::Vector2d& at) {
    const auto vectors = lattice_waves(at);
    double sum = 0.0;
    for (std::size_t w = 0; w < weight.size(); ++w) sum += weight[w] * waves.power_at(vectors[w]);
    return sum;
  };
  double most = power_at(b);
  const double finest = kFinestStep * static_cast<double>(kLatticePadding) * step_per_m;
  for (double step = step_per_m; step > finest;) {
    bool moved = false;
    for (const Eigen::Vector2d& way :
         {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
      const double power = power_at(b + step * way);
      if (!(power > most)) continue;
      most = power;
      b += step * way;
      moved = true;
      break;
    }
    if (!moved) step *= 0.5;
  }
  return b;
}

// The shortest wave of the table: its ordinates, 16 x/λ by 4 y/λ over a path of x by y, and the places of b, 8 (x/λ)²,
// grow with the square of a path's length; those of a wild path of 10 m would take hours.
double shortest_wave_m(const BentPath& path, double min_pitch_m) {
  const auto [low, high] = std::minmax_element(path.left_m().begin(), path.left_m().end());
  const double x_m = path.chord_m(), y_m = *high - *low;
  return std::max(min_pitch_m, std::sqrt((64.0 * x_m * y_m + 8.0 * x_m * x_m) / kMostPlaces));
}

}  // namespace

std::optional<Lattice> find_lattice(const BentPath& path, std::span<const double> height_m, double spacing_m,
                                    const TextureNoise& noise, double most_noise, const PeriodicityConfig& config,
                                    double chance) {
  if (!path.crosses(0.0)) return std::nullopt;
  const double lowest_per_m = 1.0 / std::min(config.max_pitch_m, path.chord_m() / kFewestRows);
  const double shortest_m = shortest_wave_m(path, config.min_pitch_m);
  const double highest_per_m = 1.0 / (std::numbers::sqrt2 * shortest_m);
  if (!(highest_per_m > lowest_per_m)) return std::nullopt;
  const PlaneWaves waves(path, height_m, spacing_m, noise, most_noise, shortest_m);
  if (waves.points() < 0.5 * static_cast<double>(waves.size()) || waves.size() < 64) return std::nullopt;
  if (!(waves.mean_square_m2() > 0.0)) return std::nullopt;
  const RarityTable table(waves, shortest_m);
  const double step_per_m = 1.0 / (static_cast<double>(kLatticePadding) * path.chord_m());

  const double both_m2 =
      waves.phase_variance(Eigen::Vector2d::UnitX()) + waves.phase_variance(Eigen::Vector2d::UnitY());
  const double slope_m2 = std::pow(2.0 * std::numbers::pi, 2) * kMeanSquareOrder * 0.5 * both_m2;
  const double quarter = 0.25 * std::numbers::pi * (highest_per_m * highest_per_m - lowest_per_m * lowest_per_m);
  const double border = 0.5 * (0.5 * std::numbers::pi * (highest_per_m + lowest_per_m));
  const double surface_share = std::max(0.0, 1.0 - noise.added_rms_m * noise.added_rms_m / waves.mean_square_m2());

  std::optional<Lattice> out;
  double most = 0.0;
  for (const Candidate& candidate : find_candidates(table, step_per_m, lowest_per_m, highest_per_m)) {
    const Eigen::Vector2d b = refined(waves, table, candidate.wave_per_m, step_per_m);
    // The climb may end beside what the chance is of: by a step it is still the candidate, further it is not.
    if (b.norm() < lowest_per_m - step_per_m || b.norm() > highest_per_m + step_per_m ||
        std::abs(b.y()) > b.x() + step_per_m)
      continue;
    const auto vectors = lattice_waves(b);
    const PlaneWaves::Standing standing = waves.standing_of(vectors);
    if (standing.rarity.empty() || standing.power_share < kLeastLatticeShare * surface_share) continue;
    double total = 0.0, strongest = 0.0;
    for (std::size_t w = 0; w < vectors.size(); ++w) {
      total += standing.rarity[w];
      strongest = std::max(strongest, standing.rarity[w]);
    }
    if (total <= most || chance_of_highest(total, slope_m2 * quarter, std::sqrt(slope_m2) * border) > chance) continue;
    if (kTrialsOfPeak * tail_of_sum(vectors.size(), standing.narrow_rarity) > chance) continue;
    if (kPlacesOfOthers * tail_of_sum(vectors.size() - 1, total - strongest) > kOthersByChance) continue;
    most = total;
    out = Lattice{b, 1.0 / (2.0 * std::numbers::pi * std::sqrt(standing.information))};
  }
  return out;
}

}  // namespace asperity

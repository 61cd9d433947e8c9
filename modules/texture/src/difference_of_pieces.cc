#include "difference_of_pieces.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/nan.h"
#include "asperity/signal/student.h"

namespace asperity {
namespace {

constexpr double kConfidence = 0.95;

double count_of(const PiecesOfLines& pieces) {
  double count = 0.0;
  for (const auto& line : pieces) count += static_cast<double>(line.size());
  return count;
}

// Deviations from the mean, and their mean product across `lag` lines.
double product_across(const PiecesOfLines& deviation, std::size_t lag) {
  double sum = 0.0, count = 0.0;
  for (std::size_t l = 0; l + lag < deviation.size(); ++l) {
    const std::size_t pieces = std::min(deviation[l].size(), deviation[l + lag].size());
    for (std::size_t p = 0; p < pieces; ++p) sum += deviation[l][p] * deviation[l + lag][p];
    count += static_cast<double>(pieces);
  }
  return count > 0.0 ? sum / count : 0.0;
}

struct Scatter {
  double variance = 0.0;     // of the mean
  double independent = 0.0;  // pieces
};

Scatter scatter_of(PiecesOfLines pieces, double overlap) {
  const double mean = mean_of_pieces(pieces), count = count_of(pieces);
  for (auto& line : pieces) {
    for (double& value : line) value -= mean;
  }
  const double power = product_across(pieces, 0);
  if (power == 0.0) return {0.0, count};
  double alike = 1.0;
  for (std::size_t lag = 1; 2 * lag < pieces.size() + 1; ++lag) {
    const double correlation = product_across(pieces, lag) / power;
    if (!(correlation > 0.0)) break;
    alike += 2.0 * correlation;
  }
  const double independent = count / (overlap * alike);
  if (!(independent > 1.5)) return {kNan, independent};
  return {power / (independent - 1.0), independent};
}

bool have_one_form(const PiecesOfLines& a, const PiecesOfLines& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return one.size() == other.size(); });
}

}  // namespace

double mean_of_pieces(const PiecesOfLines& pieces) {
  double sum = 0.0;
  for (const auto& line : pieces) {
    for (const double value : line) sum += value;
  }
  const double count = count_of(pieces);
  return count > 0.0 ? sum / count : kNan;
}

double difference_interval(const PiecesOfLines& a, const PiecesOfLines& b, double overlap) {
  const double mean_a = mean_of_pieces(a), mean_b = mean_of_pieces(b);
  if (!std::isfinite(mean_a) || !std::isfinite(mean_b)) return kNan;
  if (have_one_form(a, b) && mean_a != 0.0) {
    PiecesOfLines differences = b;
    for (std::size_t l = 0; l < a.size(); ++l) {
      for (std::size_t p = 0; p < a[l].size(); ++p) differences[l][p] -= a[l][p] * mean_b / mean_a;
    }
    const Scatter s = scatter_of(std::move(differences), overlap);
    if (s.variance == 0.0) return 0.0;
    return student_quantile(kConfidence, std::max(1.0, s.independent - 1.0)) * std::sqrt(s.variance);
  }
  const Scatter of_a = scatter_of(a, overlap), of_b = scatter_of(b, overlap);
  const double ratio = mean_a != 0.0 ? mean_b / mean_a : 1.0;
  const double variance = of_b.variance + of_a.variance * ratio * ratio;
  const double freedom = std::max(1.0, std::min(of_a.independent, of_b.independent) - 1.0);
  return variance == 0.0 ? 0.0 : student_quantile(kConfidence, freedom) * std::sqrt(variance);
}

}  // namespace asperity

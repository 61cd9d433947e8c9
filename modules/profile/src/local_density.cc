#include "local_density.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace asperity {

namespace {

constexpr std::size_t kFewestOrdinates = 6;
constexpr double kLineRatio = 7.0;
constexpr double kEuler = 0.5772156649015329;  // the logarithm of an exponential variable is that below, on the average
constexpr int kLineRounds = 3, kScoringSteps = 40;
constexpr double kLongestStep = 1.0;  // of the logarithm: an ordinate far above the fit would lead past the minimum

}  // namespace

LocalDensity fit_local_density(std::span<const double> offset, std::span<const double> power) {
  std::vector<double> x, p;
  for (std::size_t i = 0; i < offset.size(); ++i) {
    if (!(power[i] > 0.0)) continue;
    x.push_back(offset[i]);
    p.push_back(power[i]);
  }
  LocalDensity out;
  for (int round = 0; round < kLineRounds; ++round) {
    if (x.size() < kFewestOrdinates) return out;
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Eigen::Vector3d row(1.0, x[i], x[i] * x[i]);
      information += row * row.transpose();
      right += row * (std::log(p[i]) + kEuler);
    }
    const Eigen::LDLT<Eigen::Matrix3d> solver(information);
    Eigen::Vector3d beta = solver.solve(right);
    for (int step = 0; step < kScoringSteps; ++step) {
      right.setZero();
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Eigen::Vector3d row(1.0, x[i], x[i] * x[i]);
        right += row * (p[i] * std::exp(-row.dot(beta)) - 1.0);
      }
      const Eigen::Vector3d change = solver.solve(right);
      double longest = 0.0;
      for (const double at : x) longest = std::max(longest, std::abs(change[0] + at * (change[1] + at * change[2])));
      beta += std::min(1.0, kLongestStep / longest) * change;
      if (longest < 1e-6) break;
    }
    out.density = std::exp(beta[0]);
    out.variance = solver.solve(Eigen::Vector3d::UnitX())[0];
    out.used = x.size();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (p[i] > kLineRatio * std::exp(beta[0] + beta[1] * x[i] + beta[2] * x[i] * x[i])) continue;
      x[kept] = x[i];
      p[kept++] = p[i];
    }
    if (kept == x.size()) return out;
    x.resize(kept);
    p.resize(kept);
  }
  return out;
}

}  // namespace asperity

#include "tip_dilation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace asperity {
namespace {

// The profile with `reach` samples more at each end, held.
std::vector<double> padded(const std::vector<double>& height_m, std::size_t reach) {
  std::vector<double> out;
  out.reserve(height_m.size() + 2 * reach);
  out.insert(out.end(), reach, height_m.front());
  out.insert(out.end(), height_m.begin(), height_m.end());
  out.insert(out.end(), reach, height_m.back());
  return out;
}

}  // namespace

std::vector<double> dilate_by_tip(const std::vector<double>& height_m, double spacing_m, double tip_radius_m) {
  const auto reach = static_cast<std::size_t>(tip_radius_m / spacing_m);
  if (height_m.empty() || reach == 0) return height_m;
  std::vector<double> sphere(2 * reach + 1);
  for (std::size_t j = 0; j < sphere.size(); ++j) {
    const double u_m = (static_cast<double>(j) - static_cast<double>(reach)) * spacing_m;
    sphere[j] = std::sqrt(std::max(0.0, tip_radius_m * tip_radius_m - u_m * u_m)) - tip_radius_m;
  }
  const std::vector<double> in = padded(height_m, reach);
  std::vector<double> out(height_m.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double top = height_m[i];
    for (std::size_t j = 0; j < sphere.size(); ++j) top = std::max(top, in[i + j] + sphere[j]);
    out[i] = top;
  }
  return out;
}

std::vector<double> smooth_by_contact(const std::vector<double>& height_m, double spacing_m, double contact_radius_m) {
  const auto reach = static_cast<std::size_t>(contact_radius_m / spacing_m);
  if (height_m.empty() || reach == 0) return height_m;
  std::vector<double> weight(2 * reach + 1);
  double sum = 0.0;
  for (std::size_t j = 0; j < weight.size(); ++j) {
    const double u = (static_cast<double>(j) - static_cast<double>(reach)) * spacing_m / contact_radius_m;
    weight[j] = std::sqrt(std::max(0.0, 1.0 - u * u));
    sum += weight[j];
  }
  for (double& w : weight) w /= sum;
  const std::vector<double> in = padded(height_m, reach);
  std::vector<double> out(height_m.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double mean = 0.0;
    for (std::size_t j = 0; j < weight.size(); ++j) mean += weight[j] * in[i + j];
    out[i] = mean;
  }
  return out;
}

}  // namespace asperity

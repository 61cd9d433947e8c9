#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace asperity {

// Moments of rows of one length under a Gaussian weight: Σ_j w(x_j − x_i) ((x_j − x_i)/width)^degree v_j for each i,
// w(x) = exp(−π (x/width)²) up to where it has fallen to 7e-7. Summed directly where the weight is short, else by
// Fourier transforms.
class GaussianMoments {
 public:
  GaussianMoments(std::size_t count, double spacing_m, double width_m, int degree);

  std::vector<double> of(std::span<const double> v) const;
  // The same for one i, always summed directly.
  double at(std::span<const double> v, std::size_t i) const;

  bool by_transforms() const { return !spectrum_.empty(); }
  std::size_t reach() const { return reach_; }               // samples to either side
  double kernel(std::size_t k) const { return kernel_[k]; }  // of the sample k − reach() further on
  double total() const;  // of the kernel: the moment of ones where the weight is whole

 private:
  std::size_t count_, reach_ = 0, padded_ = 0;
  std::vector<double> kernel_;
  std::vector<std::complex<double>> spectrum_;
};

}  // namespace asperity

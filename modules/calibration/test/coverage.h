#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace asperity::test {

// Errors of estimates over their standard errors, by parameter, over many trials.
class Coverage {
 public:
  void add(const std::string& parameter, double estimate, double truth, double standard_error) {
    errors_[parameter].push_back((estimate - truth) / standard_error);
  }

  // Prints bias and coverage at 1, 2 and 3 standard errors and expects at least `least` of the trials within 3, at most
  // `most_within_1` within 1: errors that are too large are as untrue as those that are too small. Their RMS is to be
  // from 0.8 to 1.25, wider by two standard deviations of what so few trials scatter.
  void expect(const std::string& title, std::size_t trials, double least = 0.95, double most_within_1 = 0.80) const {
    std::printf("%s, %zu trials: bias in standard errors, share within 1, 2, 3 (expected 0.683 0.954 0.997)\n",
                title.c_str(), trials);
    for (const auto& [parameter, z] : errors_) {
      double sum = 0.0, squares = 0.0;
      double within[3] = {0.0, 0.0, 0.0};
      for (const double one : z) {
        sum += one;
        squares += one * one;
        for (int k = 0; k < 3; ++k) within[k] += std::abs(one) <= k + 1.0 ? 1.0 : 0.0;
      }
      const auto n = static_cast<double>(z.size());
      const double rms = std::sqrt(squares / n);
      std::printf("  %-28s %6.2f  %.3f %.3f %.3f  RMS %.2f\n", parameter.c_str(), sum / n, within[0] / n, within[1] / n,
                  within[2] / n, rms);
      const double scatter = 2.0 / std::sqrt(2.0 * n);
      EXPECT_GE(rms, 0.8 - scatter) << parameter;
      EXPECT_LE(rms, 1.25 + scatter) << parameter;
      EXPECT_EQ(z.size(), trials) << parameter;
      EXPECT_GE(within[2] / n, least) << parameter;
      EXPECT_LE(within[0] / n, most_within_1) << parameter;
    }
  }

 private:
  std::map<std::string, std::vector<double>> errors_;
};

}  // namespace asperity::test

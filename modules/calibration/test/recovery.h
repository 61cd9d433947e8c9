#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

namespace asperity::test {

inline constexpr int kTrials = 200;

// Counts, for every parameter, how often a calibration lies within 1, 2 and 3 of the standard errors that it states
// itself. True errors give 68, 95 and 99.7 % (somewhat less with few degrees of freedom: Student's t).
class Recovery {
 public:
  void add(const std::string& parameter, double found, double standard_error, double truth) {
    Row& row = rows_[parameter];
    const double off = std::abs(found - truth);
    ++row.trials;
    for (int k = 0; k < 3; ++k) row.within[k] += off <= (k + 1) * standard_error ? 1 : 0;
    row.bias += (found - truth) / standard_error;
    row.square += std::pow((found - truth) / standard_error, 2);
  }

  // Prints the shares and expects what true errors keep: at least 95 % within three, and no bias nor spread that 200
  // trials would show at five of their own standard errors.
  void expect_true(const std::string& name) const {
    std::printf("%s\n  %-12s %8s %8s %8s %10s %10s\n", name.c_str(), "parameter", "1 sigma", "2 sigma", "3 sigma",
                "mean/sigma", "rms/sigma");
    for (const auto& [parameter, row] : rows_) {
      const double n = row.trials;
      std::printf("  %-12s %7.1f%% %7.1f%% %7.1f%% %10.3f %10.3f\n", parameter.c_str(), 100.0 * row.within[0] / n,
                  100.0 * row.within[1] / n, 100.0 * row.within[2] / n, row.bias / n, std::sqrt(row.square / n));
      EXPECT_EQ(row.trials, kTrials) << parameter;
      EXPECT_GE(row.within[2], 0.95 * n) << parameter;
      EXPECT_LE(std::abs(row.bias / n), 5.0 / std::sqrt(n)) << parameter;
      EXPECT_LE(std::sqrt(row.square / n), 1.35) << parameter;
      EXPECT_GE(std::sqrt(row.square / n), 0.7) << parameter << ": the errors stated are too large";
    }
  }

 private:
  struct Row {
    int trials = 0;
    int within[3] = {0, 0, 0};
    double bias = 0.0;
    double square = 0.0;
  };
  std::map<std::string, Row> rows_;
};

}  // namespace asperity::test

#pragma once

#include <array>

#include "inertial_smoother.h"

namespace asperity {

// The factor on the process noise under which the poses are likeliest, found while they come: three filters run side by
// side, with a weaker, the present and a stronger noise, and when one of the others has told the poses of the last
// second or two better, its factor and its state are taken over.
class NoiseScale {
 public:
  // A factor above 0 is kept for good.
  explicit NoiseScale(double fixed) : fixed_(fixed > 0.0), factor_(fixed_ ? fixed : 1.0) {}

  double factor() const { return factor_; }

  // `window` as it has been filtered with the present factor from its start, and the filter at its checkpoint's epoch.
  // From where the filter is to go on.
  inertial_smoother::Checkpoint judge(const inertial_smoother::Problem& window,
                                      const inertial_smoother::Checkpoint& checkpoint);
  // The filter begins anew; the factor stays.
  void forget() { running_ = false; }

 private:
  struct Rival {
    inertial_smoother::Checkpoint state;
    double score = 0.0;  // log-likelihood, older poses forgotten
  };
  bool fixed_;
  double factor_;
  bool running_ = false;
  std::array<Rival, 3> rivals_;
};

}  // namespace asperity

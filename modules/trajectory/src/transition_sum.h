#pragma once

#include "inertial_model.h"

namespace asperity::inertial_smoother {

// A Transition while its interval is run through, segment by segment: its matrices are columns of four numbers, of
// which the last is 0, so that a processor with AVX2 does a column at once. The order of the sums is the same on all:
// the same bytes.
class TransitionSum {
 public:
  explicit TransitionSum(const Problem& problem) : layout_(&problem.layout) {}

  void extend(const Step& s, const Knot& k0, const Knot& k1, const Mounting& mounting, bool gyro_turns_too);
  Transition transition() const;

  using Four [[gnu::vector_size(32)]] = double;
  struct Sums {
    Four sv{}, sp{};
    Four g1[3]{}, g2[3]{}, vbg[3]{}, pbg[3]{};
    Four vEa[9]{}, pEa[9]{};
    Four phiEg[9]{}, vEg[9]{}, pEg[9]{};
  };

 private:
  const Layout* layout_;
  Sums sums_;
  Transition rest_;  // what is not in sums_
};

}  // namespace asperity::inertial_smoother

#include "asperity/profile/integrate_verlet.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

std::vector<double> integrate_verlet(std::span<const double> a_mps2, double period_s) {
  if (!(period_s > 0.0)) throw Error("Verlet integration: period " + number_text(period_s) + " s is not positive");
  std::vector<double> h_m(a_mps2.size());
  if (h_m.empty()) return h_m;
  const double dt2 = period_s * period_s;
  double step_m = -0.5 * a_mps2[0] * dt2;  // from rest: the step before the first mirrors the one after it
  double now_m = 0.0;
  for (std::size_t i = 0; i < h_m.size(); ++i) {
    h_m[i] = now_m;
    step_m += a_mps2[i] * dt2;
    now_m += step_m;
  }
  return h_m;
}

}  // namespace asperity

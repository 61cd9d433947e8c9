#include "asperity/profile/surface_under_tip.h"

#include <cmath>
#include <numbers>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/signal/zero_phase.h"

namespace asperity {

std::vector<double> surface_above_tip_m(const TipMotion& motion, const BasePath& base, std::span<const char> contact,
                                        double contact_resonance_Hz) {
  const std::size_t n = motion.size();
  if (n < 2 || motion.a_world_tip_mps2.size() != n || base.n_world.size() != n ||
      (!contact.empty() && contact.size() != n)) {
    throw Error("surface under the tip: motion, accelerations, base path and contact differ in size (" +
                std::to_string(n) + " samples)");
  }
  const double span_s = static_cast<double>(motion.t_ns.back() - motion.t_ns.front()) * kNanosecond_s;
  const double rate_Hz = static_cast<double>(n - 1) / span_s;
  if (!(contact_resonance_Hz > 0.0) || !(contact_resonance_Hz < 0.2 * rate_Hz)) {
    throw Error("profile.contact_resonance_Hz: " + number_text(contact_resonance_Hz) +
                " Hz; it must be below a fifth of the " + number_text(std::round(rate_Hz)) + " samples a second");
  }
  std::vector<double> a_mps2(n);
  for (std::size_t i = 0; i < n; ++i) a_mps2[i] = base.n_world[i].dot(motion.a_world_tip_mps2[i]);
  std::vector<double> out = zero_phase_lowpass(a_mps2, 0.5 * contact_resonance_Hz, rate_Hz);
  const double square = std::pow(2.0 * std::numbers::pi * contact_resonance_Hz, 2);
  for (std::size_t i = 0; i < n; ++i) out[i] = contact.empty() || contact[i] != 0 ? out[i] / square : 0.0;
  return out;
}

}  // namespace asperity

#include "asperity/profile/find_contact.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/units.h"
#include "asperity/signal/moving_average.h"
#include "asperity/signal/resample.h"

namespace asperity {

std::vector<char> find_contact(const TipMotion& motion, const ContactConfig& config) {
  if (config.release_N > config.touch_N) {
    throw Error("contact: release_N " + number_text(config.release_N) + " is above touch_N " +
                number_text(config.touch_N));
  }
  const std::size_t n = motion.size();
  std::vector<char> contact(n, 1);
  const bool measured =
      std::any_of(motion.force_N.begin(), motion.force_N.end(), [](double f) { return std::isfinite(f); });
  if (n < 2 || !measured) return contact;

  std::vector<double> t_s(n);
  for (std::size_t i = 0; i < n; ++i) t_s[i] = static_cast<double>(motion.t_ns[i] - motion.t_ns[0]) * kNanosecond_s;
  const double step_s = t_s.back() / static_cast<double>(n - 1);
  const auto half_width = static_cast<std::size_t>(0.5 * config.smoothing_s / step_s);
  const std::vector<double> force_N = moving_average(bridge_gaps(t_s, motion.force_N), half_width);

  bool touching = force_N[0] >= 0.5 * (config.touch_N + config.release_N);
  for (std::size_t i = 0; i < n; ++i) {
    touching = touching ? force_N[i] >= config.release_N : force_N[i] >= config.touch_N;
    contact[i] = touching ? 1 : 0;
  }
  const std::vector<char> raw = contact;
  for (std::size_t i = 0; i < n;) {
    if (raw[i] != 0) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < n && raw[end] == 0) ++end;
    // A flight has contact on both sides; before the first touch and after the last there is none.
    const bool flight = i > 0 && end < n && t_s[end] - t_s[i - 1] <= config.max_flight_s;
    if (flight) {
      std::fill(contact.begin() + static_cast<std::ptrdiff_t>(i), contact.begin() + static_cast<std::ptrdiff_t>(end),
                1);
    } else {
      for (std::size_t k = i; k > 0 && t_s[i] - t_s[k - 1] <= config.margin_s; --k) contact[k - 1] = 0;
      for (std::size_t k = end; k < n && t_s[k] - t_s[end - 1] <= config.margin_s; ++k) contact[k] = 0;
    }
    i = end;
  }
  return contact;
}

}  // namespace asperity

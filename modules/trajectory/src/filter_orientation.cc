#include "asperity/trajectory/filter_orientation.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

std::vector<Eigen::Quaterniond> make_signs_continuous(std::span<const Eigen::Quaterniond> q) {
  std::vector<Eigen::Quaterniond> out(q.begin(), q.end());
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (out[i].dot(out[i - 1]) < 0.0) out[i].coeffs() *= -1.0;
  }
  return out;
}

std::vector<Eigen::Quaterniond> filter_orientation(std::span<const Eigen::Quaterniond> measured, double process_rad2,
                                                   double measurement_rad2) {
  if (!(measurement_rad2 > 0.0)) {
    throw Error("orientation filter: measurement variance " + number_text(measurement_rad2) + " is not positive");
  }
  std::vector<Eigen::Quaterniond> out = make_signs_continuous(measured);
  if (out.empty()) return out;
  const double process = 0.25 * process_rad2;
  const double noise = 0.25 * measurement_rad2;
  double variance = noise;
  Eigen::Vector4d state = out[0].coeffs();
  for (std::size_t i = 1; i < out.size(); ++i) {
    variance += process;
    const double gain = variance / (variance + noise);
    state += gain * (out[i].coeffs() - state);
    state.normalize();
    variance *= 1.0 - gain;
    out[i].coeffs() = state;
  }
  return out;
}

}  // namespace asperity

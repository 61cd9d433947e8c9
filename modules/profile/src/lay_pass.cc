#include "asperity/profile/lay_pass.h"

#include <cmath>
#include <utility>

#include "asperity/base/nan.h"
#include "pass_signal.h"
#include "warp_pass.h"

namespace asperity {

namespace {

double place_sigma_mm(const ProfilePass& pass, const AlignPassesConfig& config) {
  return 1e3 * (std::isfinite(pass.place_sigma_m) ? pass.place_sigma_m : config.place_sigma_m);
}

}  // namespace

std::vector<double> lay_pass(const ProfilePass& reference, const ProfilePass& pass, const PassAlignment& alignment,
                             const AlignPassesConfig& config) {
  const PassSignal target = pass_signal(reference);
  PassSignal signal = pass_signal(pass);
  if (alignment.reversed) signal = reversed(std::move(signal));
  // The signal's first height, in the direction of travel.
  const double first = alignment.reversed ? static_cast<double>(pass.size() - signal.first - signal.size())
                                          : static_cast<double>(signal.first);
  std::vector<double> places(target.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] =
        alignment.shift_m / pass.spacing_m - first + static_cast<double>(i + target.first) * (1.0 + alignment.stretch);
  }
  if (alignment.agrees) {
    const double sigma_mm = std::hypot(place_sigma_mm(reference, config), place_sigma_mm(pass, config));
    WarpedPlaces warped =
        warp_pass({target.height_m, target.known, target.frequency, target.noise, target.states_noise}, signal, places,
                  {sigma_mm, 1e3 * config.knot_spacing_m}, config);
    if (warped.converged) places = std::move(warped.places);
  }
  std::vector<double> out(reference.size(), kNan);
  const double last = static_cast<double>(signal.size() - 1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!(places[i] >= 0.0) || !(places[i] <= last)) continue;
    const double in_signal = alignment.reversed ? last - places[i] : places[i];
    out[i + target.first] = in_signal + static_cast<double>(signal.first);
  }
  return out;
}

}  // namespace asperity

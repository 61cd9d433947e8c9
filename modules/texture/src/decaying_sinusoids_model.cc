#include "asperity/texture/decaying_sinusoids_model.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/smoothstep.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"

namespace asperity {

using RingingTraits = TextureModelTraits<DecayingSinusoids>;

namespace {

// Under less load a ringing tool lets go of the surface.
constexpr double kRingingLoad_N = 0.05;

}  // namespace

Json RingingTraits::describe(const DecayingSinusoids& t) {
  return {{"a_per_s", t.a_per_s},
          {"b_per_kg", t.b_per_kg},
          {"decay_per_s", t.decay_per_s},
          {"omega_rad_per_s", t.omega_rad_per_s},
          {"pitch_m", t.pitch_m}};
}

void RingingTraits::scale(DecayingSinusoids& t, double factor) { t.mass_kg *= factor; }

void RingingTraits::add_to(TextureHash& hash, const DecayingSinusoids& t) {
  hash.add(t.a_per_s, t.b_per_kg, t.decay_per_s, t.omega_rad_per_s, t.mass_kg, t.tangential_ratio, t.pitch_m);
}

SeriesContactForce RingingTraits::contact_force(const DecayingSinusoids& t, SeriesState& state,
                                                const SeriesContact& contact) noexcept {
  const double acceleration_mps2 = next_acceleration_mps2(t, state, contact.speed_mps, contact.load_N, contact.dt_s);
  const double carried = smoothstep(contact.load_N / kRingingLoad_N);
  const double force_N =
      std::max(carried * contact.fade * contact.compliance_kc * t.mass_kg * acceleration_mps2, -contact.load_N);
  return {force_N, t.tangential_ratio * force_N, 0.0, 0.0};
}

void RingingTraits::start_contact(const DecayingSinusoids& t, SeriesState& state,
                                  const SeriesContact& contact) noexcept {
  next_acceleration_mps2(t, state, contact.speed_mps, contact.load_N, contact.dt_s);
  // The air has no part in the ringing: a new contact begins at rest, its force at zero.
  state.ringing = {};
  start_tap(t, state, contact.approach_mps, contact.load_N);
}

void RingingTraits::stroke(const DecayingSinusoids& t, const StrokeConfig& c, std::vector<double>& acceleration_mps2,
                           const Observer& observer) {
  SeriesState state = start_series(static_cast<std::uint64_t>(c.seed));
  if (!(t.pitch_m > 0.0)) start_tap(t, state, c.speed_mps, c.force_N);
  RowWatch watch(observer);
  for (double& a : acceleration_mps2) {
    watch.next();
    a = next_acceleration_mps2(t, state, c.speed_mps, c.force_N, 1.0 / c.rate_Hz);
  }
}

void RingingTraits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  std::vector<SeriesTable> tables;
  for (const auto& file : input.files) tables.push_back(input.read_series(file));
  std::vector<TapRecording> taps;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const SeriesTable& table = tables[i];
    if (std::abs(table.rate_Hz - tables.front().rate_Hz) > 1e-3 * tables.front().rate_Hz)
      throw Error(input.files[i] + ": another rate than " + input.files.front());
    taps.push_back({table.acceleration_mps2, table.speed_mps.front(), table.force_N.front()});
  }
  FitDecayingSinusoidsConfig config = options.of<DecayingSinusoids>().decaying_sinusoids;
  config.rate_Hz = tables.front().rate_Hz;
  const DecayingSinusoidsFit fit = fit_decaying_sinusoids(taps, config);
  out.report["taps"] = taps.size();
  out.report["rms_mps2"] = fit.rms_mps2;
  out.report["rms_error_mps2"] = fit.rms_error_mps2;
  out.report["converged"] = fit.converged;
  out.report["speed_and_force_determined"] = fit.speed_and_force_determined;
  out.add_problems(fit.problems);
  out.texture.model = fit.texture;
}

}  // namespace asperity

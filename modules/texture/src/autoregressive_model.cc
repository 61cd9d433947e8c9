#include "asperity/texture/autoregressive_model.h"

#include <algorithm>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/convert_rate.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/synthesize_stroke.h"
#include "asperity/texture/texture_fit.h"
#include "asperity/texture/texture_hash.h"

namespace asperity {

using AutoregressiveTraits = TextureModelTraits<AutoregressiveTexture>;

Json AutoregressiveTraits::describe(const AutoregressiveTexture& t) {
  return {{"rate_Hz", t.rate_Hz},
          {"models", t.models.size()},
          {"order", t.models.empty() ? 0 : t.models.front().ar_lsf_rad.size()},
          {"triangles", t.triangles.size()},
          {"mass_kg", t.mass_kg}};
}

void AutoregressiveTraits::scale(AutoregressiveTexture& t, double factor) { t.mass_kg *= factor; }

void AutoregressiveTraits::add_to(TextureHash& hash, const AutoregressiveTexture& t) {
  hash.add(t.rate_Hz, t.mass_kg, t.tangential_ratio, t.fade_speed_mps, t.fade_force_N, t.max_speed_mps, t.max_force_N);
  for (const AutoregressiveModel& m : t.models)
    hash.add(m.speed_mps, m.force_N, m.gain, m.variance, m.ar_lsf_rad, m.ma_lsf_rad);
  for (const auto& triangle : t.triangles) {
    for (const int corner : triangle) hash.add(static_cast<std::uint64_t>(corner));
  }
}

SeriesContactForce AutoregressiveTraits::contact_force(const AutoregressiveTexture& t, SeriesState& state,
                                                       const SeriesContact& contact) noexcept {
  const double force_N = contact.fade * contact.compliance_kc * t.mass_kg *
                         next_acceleration_mps2(t, state, contact.speed_mps, contact.load_N, contact.dt_s);
  const double carried_N = std::clamp(force_N, -contact.load_N, contact.load_N);
  return {carried_N, t.tangential_ratio * carried_N, 0.0, 0.0};
}

void AutoregressiveTraits::stroke(const AutoregressiveTexture& t, const StrokeConfig& c,
                                  std::vector<double>& acceleration_mps2, const Observer& observer) {
  const auto converted = convert_rate(t, {.rate_Hz = c.rate_Hz});
  SeriesState state = start_series(static_cast<std::uint64_t>(c.seed));
  RowWatch watch(observer);
  for (double& a : acceleration_mps2) {
    watch.next();
    a = next_acceleration_mps2(converted, state, c.speed_mps, c.force_N, 1.0 / c.rate_Hz);
  }
}

void AutoregressiveTraits::prepare(AutoregressiveTexture& t, double rate_Hz) {
  if (!(rate_Hz >= 1.0 && rate_Hz <= 1e6))
    throw Error("render: a rate of " + number_text(rate_Hz) + " Hz is not within 1 and 1e6 Hz");
  if (t.rate_Hz != rate_Hz) t = convert_rate(t, {.rate_Hz = rate_Hz});
}

void AutoregressiveTraits::fit(const TextureFitInput& input, const TextureFitOptions& options, FittedTexture& out) {
  if (input.files.size() > 1)
    throw TextureFitFilesError("autoregressive takes one recording, or one Penn Haptic Texture XML");
  const std::string& file = input.files.front();
  if (file.ends_with(".xml")) {
    PennTexture penn = import_penn(file, options.of<AutoregressiveTexture>().penn);
    out.report["models"] = penn.texture.models.size();
    out.texture.friction = penn.friction;
    out.add_problems(penn.problems);
    out.texture.model = std::move(penn.texture);
    return;
  }
  const SeriesTable table = input.read_recording_or_series(file);
  AutoregressiveFit fit = fit_autoregressive({table.acceleration_mps2, table.speed_mps, table.force_N, table.rate_Hz},
                                             options.of<AutoregressiveTexture>().autoregressive);
  out.report["samples"] = fit.samples;
  out.report["models"] = fit.texture.models.size();
  out.report["order"] = fit.order;
  if (fit.held_out.samples > 0) {
    out.report["held_out"] = {{"variance_error", fit.held_out.variance_error},
                              {"spectrum_error", fit.held_out.spectrum_error},
                              {"worst_band_error", fit.held_out.worst_band_error},
                              {"samples", fit.held_out.samples}};
  }
  out.add_problems(fit.problems);
  out.texture.model = std::move(fit.texture);
}

}  // namespace asperity

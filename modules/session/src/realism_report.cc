#include <fmt/format.h>

#include <cmath>

#include "asperity/base/text.h"
#include "asperity/session/rendered_input.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity {

namespace {

Json interval(double low, double high) { return {number_or_null(low), number_or_null(high)}; }

Json channel_json(const RealismChannel& channel, const std::string& unit, const std::string& per_unit) {
  const SignalAgreement& r = channel.rendered;
  Json out;
  out["score"] = number_or_null(channel.score);
  out["correlation"] = number_or_null(r.correlation);
  out["distance_dB"] = number_or_null(r.distance_dB);
  out["level_dB"] = number_or_null(r.level_dB);
  out["real_rms_" + unit] = number_or_null(r.real_rms);
  out["rendered_rms_" + unit] = number_or_null(r.other_rms);
  out["ceiling"] = {{"score", number_or_null(channel.ceiling_score)},
                    {"correlation", number_or_null(channel.ceiling_correlation)},
                    {"distance_dB", number_or_null(channel.ceiling_distance_dB)},
                    {"level_dB", number_or_null(channel.ceiling_level_dB)}};
  out["bands"] = Json::array();
  for (const BandSignals& band : r.bands) {
    out["bands"].push_back({{"low_cycles_per_mm", band.low_cycles_per_mm},
                            {"high_cycles_per_mm", band.high_cycles_per_mm},
                            {"real_rms_" + per_unit, number_or_null(band.real_rms)},
                            {"rendered_rms_" + per_unit, number_or_null(band.other_rms)},
                            {"difference_dB", number_or_null(band.difference_dB)},
                            {"correlation", number_or_null(band.correlation)},
                            {"coherence", number_or_null(band.coherence)},
                            {"chance", number_or_null(band.threshold)},
                            {"compared", band.is_compared}});
  }
  return out;
}

Json alignment_json(const PassAlignment& at) {
  return {{"found", at.agrees},    {"direction", at.reversed ? "backward" : "forward"},
          {"shift_m", at.shift_m}, {"stretch", at.stretch},
          {"agreement", at.score}, {"chance", at.threshold}};
}

std::string channel_text(const char* name, const RealismChannel& channel, const char* unit) {
  const SignalAgreement& r = channel.rendered;
  std::string out = fmt::format(
      "  {:<12} real {:.3g} {} RMS, rendered {:.3g} ({:+.1f} dB); spectra {:.1f} dB apart, correlation {:.3f}", name,
      r.real_rms, unit, r.other_rms, r.level_dB, r.distance_dB, r.correlation);
  if (std::isfinite(channel.ceiling_correlation)) {
    out +=
        fmt::format("; two real strokes {:.1f} dB, {:.3f}", channel.ceiling_distance_dB, channel.ceiling_correlation);
  }
  return out + "\n";
}

}  // namespace

Json realism_json(const RealismScore& score) {
  Json out;
  out["score"] = number_or_null(score.score);
  out["score_95"] = interval(score.low, score.high);
  out["ceiling"] = number_or_null(score.ceiling);
  out["ceiling_95"] = interval(score.ceiling_low, score.ceiling_high);
  out["acceleration"] = channel_json(score.acceleration, "mps2", "mps2");
  out["force"] = channel_json(score.force, "N", "N");
  out["friction"] = {{"real", number_or_null(score.friction.real)},
                     {"rendered", number_or_null(score.friction.rendered)},
                     {"other", number_or_null(score.friction.other)},
                     {"score", number_or_null(score.friction.score)}};
  out["contact"] = {{"stiffness_N_per_m", score.contact.stiffness_N_per_m},
                    {"stiffness_known", score.stiffness_known},
                    {"friction", score.contact.friction},
                    {"friction_known", score.friction_known}};
  out["hand"] = {{"mass_kg", score.hand.mass_kg},
                 {"mass_stderr_kg", number_or_null(score.hand.mass_sigma_kg)},
                 {"damping_N_s_per_m", score.hand.damping_N_s_per_m},
                 {"stiffness_N_per_m", score.hand.stiffness_N_per_m},
                 {"measured", score.hand.measured},
                 {"explained", number_or_null(score.hand.explained)}};
  out["alignment"] = alignment_json(score.alignment);
  out["compared_m"] = score.compared_m;
  out["segments"] = score.segments;
  out["speed_mps"] = score.speed_mps;
  if (!score.no_places.empty()) out["no_places"] = score.no_places;
  out["others"] = Json::array();
  for (const OtherStroke& other : score.others) {
    out["others"].push_back({{"name", other.name},
                             {"score", number_or_null(other.score)},
                             {"speed_mps", other.speed_mps},
                             {"alignment", alignment_json(other.alignment)}});
  }
  out["trustworthy"] = score.trustworthy;
  out["verdict"] = verdict_sentence(score.verdicts);
  out["verdicts"] = verdicts_json(score.verdicts);
  return out;
}

std::string realism_text(const RealismScore& score) {
  std::string out = std::isfinite(score.score)
                        ? fmt::format("real against rendered: {:.3f} of 1, 95 %: {:.3f} to {:.3f}", score.score,
                                      score.low, score.high)
                        : std::string("real against rendered: not determined");
  out += std::isfinite(score.ceiling) ? fmt::format("; two real strokes have {:.3f}, 95 %: {:.3f} to {:.3f}\n",
                                                    score.ceiling, score.ceiling_low, score.ceiling_high)
                                      : std::string("; the agreement of two real strokes is not determined\n");
  out += channel_text("acceleration", score.acceleration, "m/s²");
  out += channel_text("force", score.force, "N");
  if (std::isfinite(score.friction.real)) {
    out += fmt::format("  {:<12} tangential over normal force: real {:.3f}, rendered {:.3f}\n", "friction",
                       score.friction.real, score.friction.rendered);
  } else {
    out += fmt::format("  {:<12} not judged: one axis of force\n", "friction");
  }
  out += fmt::format("  {:<12} {} N/m ({}), friction {} ({})\n", "contact",
                     number_text(score.contact.stiffness_N_per_m), score.stiffness_known ? "of the scene" : "assumed",
                     number_text(score.contact.friction), score.friction_known ? "of the scene" : "assumed");
  out += fmt::format("  {:<12} {:.3g} g, {:.3g} N s/m, {:.3g} N/m, {}\n", "hand", 1e3 * score.hand.mass_kg,
                     score.hand.damping_N_s_per_m, score.hand.stiffness_N_per_m,
                     score.hand.measured
                         ? fmt::format("which explain {:.0f} % of the force's power", 100.0 * score.hand.explained)
                         : std::string("assumed"));
  return out + fmt::format("  {:<12} {:.1f} mm in {} segments, at {:.1f} mm/s\n", "compared", 1e3 * score.compared_m,
                           score.segments, 1e3 * score.speed_mps);
}

}  // namespace asperity

#include "asperity/session/feel_report.h"

#include <fmt/format.h>
#include <cstring>

#include <algorithm>
#include <cmath>

#include "asperity/json/json.h"
#include "asperity/verdict/verdict_json.h"

namespace asperity {

namespace {

Json spectrum_json(const SpectrumAgreement& spectrum, const char* unit) {
  Json out;
  out[std::string("real_rms_") + unit] = number_or_null(spectrum.real_rms);
  out[std::string("rendered_rms_") + unit] = number_or_null(spectrum.rendered_rms);
  out["rms_ratio"] = number_or_null(spectrum.rms_ratio);
  out["distance_dB"] = number_or_null(spectrum.distance_dB);
  out["octaves"] = Json::array();
  for (const BandAgreement& band : spectrum.bands) {
    out["octaves"].push_back({{"low_cycles_per_mm", band.low_cycles_per_mm},
                              {"high_cycles_per_mm", band.high_cycles_per_mm},
                              {std::string("real_rms_") + unit, band.real_rms},
                              {std::string("rendered_rms_") + unit, band.rendered_rms},
                              {"difference_dB", band.difference_dB},
                              {"felt", band.is_compared}});
  }
  return out;
}

}  // namespace

void FeelStatistics::add(const ServoTick& tick) {
  const ServoOutput& output = tick.output;
  ++ticks_;
  sticking_ += output.sticking ? 1 : 0;
  starting_inside_ += output.starts_inside ? 1 : 0;
  for (std::size_t k = 0; k < causes_.size(); ++k) causes_[k] += (tick.limited_by >> k) & 1U;
  const double force_N = output.force_N.norm(), out_N = tick.out_world_N.norm();
  peak_N_ = std::max(peak_N_, force_N);
  square_N2_ += force_N * force_N;
  peak_out_N_ = std::max(peak_out_N_, out_N);
  square_out_N2_ += out_N * out_N;
  peak_contact_N_ = std::max(peak_contact_N_, output.contact_N.norm());
  peak_texture_N_ = std::max(peak_texture_N_, output.texture_N.norm());
  peak_friction_N_ = std::max(peak_friction_N_, output.friction_N.norm());
  if (!output.contact.found() || force_N == 0.0) return;
  ++touching_;
  lowest_m_ = std::min(lowest_m_, output.texture_height_m);
  highest_m_ = std::max(highest_m_, output.texture_height_m);
}

std::size_t FeelStatistics::caused(SafetyCause cause) const {
  for (std::size_t k = 0; k < causes_.size(); ++k) {
    if (flag(cause) == 1U << k) return causes_[k];
  }
  return 0;
}

Json FeelStatistics::json() const {
  const double count = std::max<double>(1.0, static_cast<double>(ticks_));
  Json out;
  out["ticks"] = ticks_;
  out["contact"] = {{"ticks", touching_}, {"sticking", sticking_}, {"starts_inside", starting_inside_}};
  out["force"] = {{"peak_N", peak_N_},
                  {"rms_N", std::sqrt(square_N2_ / count)},
                  {"peak_contact_N", peak_contact_N_},
                  {"peak_texture_N", peak_texture_N_},
                  {"peak_friction_N", peak_friction_N_},
                  {"peak_out_N", peak_out_N_},
                  {"rms_out_N", std::sqrt(square_out_N2_ / count)}};
  out["texture_height"] = {{"lowest_m", number_or_null(lowest_m_)}, {"highest_m", number_or_null(highest_m_)}};
  out["safety"] = Json::object();
  for (std::size_t k = 0; k < causes_.size(); ++k) {
    if (causes_[k] > 0) out["safety"][std::string(kSafetyCauseNames[k])] = causes_[k];
  }
  return out;
}

std::string FeelStatistics::text() const {
  const double count = std::max<double>(1.0, static_cast<double>(ticks_));
  std::string out = fmt::format("force      peak {:.3f} N, RMS {:.3f} N; to the hand at most {:.3f} N\n", peak_N_,
                                std::sqrt(square_N2_ / count), peak_out_N_);
  out += fmt::format("contact    {:.0f} % of {} ticks", 100.0 * static_cast<double>(touching_) / count, ticks_);
  if (touching_ > 0) {
    out += fmt::format(", texture from {:.0f} to {:.0f} µm, sticking {:.0f} %", lowest_m_ * 1e6, highest_m_ * 1e6,
                       100.0 * static_cast<double>(sticking_) / static_cast<double>(touching_));
  }
  return out + "\n";
}

Json renderer_check_json(const RendererCheck& score) {
  Json out;
  out["score"] = score.score;
  out["height_score"] = score.height_score;
  out["force_score"] = score.force_score;
  out["comparison"] = score.comparison;
  out["trustworthy"] = score.trustworthy;
  out["verdict"] = verdict_sentence(score.verdicts);
  out["verdicts"] = verdicts_json(score.verdicts);
  out["band_cycles_per_mm"] = {score.low_cycles_per_mm, score.high_cycles_per_mm};
  out["speed_mps"] = score.speed_mps;
  out["compared_m"] = number_or_null(score.compared_m);
  out["ticks"] = score.ticks;
  out["touched"] = score.contact_fraction;
  out["phase_known"] = score.phase_known;
  if (!score.phase_known) out["phase_unknown"] = score.phase_unknown;
  out["correlation"] = number_or_null(score.correlation);
  out["gain"] = number_or_null(score.gain);
  out["shift_m"] = number_or_null(score.shift_m);
  out["distribution_distance"] = number_or_null(score.distribution_distance);
  out["height"] = spectrum_json(score.height, "m");
  out["force"] = spectrum_json(score.force, "N");
  out["measured_force"] = spectrum_json(score.measured_force, "N");
  return out;
}

std::string renderer_check_text(const RendererCheck& score) {
  std::string out = fmt::format(
      "renderer   {:.3f} of 1 (heights {:.3f}, force {:.3f}), over {:.1f} mm from {:.2f} to {:.2f} "
      "cycles/mm: {}\n",
      score.score, score.height_score, score.force_score, score.compared_m * 1e3, score.low_cycles_per_mm,
      score.high_cycles_per_mm, score.comparison);
  out += fmt::format("  heights  real {:.1f} µm RMS, rendered {:.1f} µm, correlation {:.3f}, gain {:.3f}\n",
                     score.height.real_rms * 1e6, score.height.rendered_rms * 1e6, score.correlation, score.gain);
  return out +
         fmt::format("  force    the texture adds {:.3f} N RMS, the real heights would {:.3f} N; measured {:.3f} N\n",
                     score.force.rendered_rms, score.force.real_rms, score.measured_force.real_rms);
}

Json timing_json(const ServoStatistics& statistics, const ServoConfig& config) {
  Json out;
  if (config.paced) {
    out["overruns"] = statistics.overruns;
    out["skipped"] = statistics.skipped;
    out["lost_ticks"] = statistics.lost_ticks;
    out["late_us"] = {{"p50", statistics.late_p50_s * 1e6},
                      {"p99", statistics.late_p99_s * 1e6},
                      {"max", statistics.late_max_s * 1e6}};
    out["real_time"] = statistics.real_time;
    out["memory_locked"] = statistics.memory_locked;
  }
  if (config.timed) {
    out["step_us"] = {{"p50", statistics.step_p50_s * 1e6},
                      {"p99", statistics.step_p99_s * 1e6},
                      {"max", statistics.step_max_s * 1e6}};
  }
  return out;
}

std::string timing_text(const ServoStatistics& statistics, const ServoConfig& config) {
  std::string out;
  if (config.paced) {
    out += fmt::format("schedule   {} overruns, {} skipped, late by {:.1f} µs at 99 %, at most {:.1f} µs{}\n",
                       statistics.overruns, statistics.skipped, statistics.late_p99_s * 1e6,
                       statistics.late_max_s * 1e6, statistics.real_time ? "" : ", without real-time priority");
    if (statistics.memory_error != 0) {
      out += fmt::format(
          "memory     not locked ({}): a page that was swapped out makes a tick late; raise the limit by `ulimit -l "
          "unlimited`, or memlock in /etc/security/limits.conf\n",
          std::strerror(statistics.memory_error));
    }
  }
  if (config.timed) {
    out += fmt::format("step       {:.2f} µs at 50 %, {:.2f} µs at 99 %, at most {:.2f} µs\n",
                       statistics.step_p50_s * 1e6, statistics.step_p99_s * 1e6, statistics.step_max_s * 1e6);
  }
  return out;
}

}  // namespace asperity

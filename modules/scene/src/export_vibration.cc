#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/scene/format_ahap.h"
#include "asperity/scene/format_haps.h"
#include "asperity/scene/format_wav.h"
#include "asperity/scene/vibration_envelope.h"
#include "export_parts.h"

namespace asperity {

namespace {

constexpr double kFullScaleShare = 0.9;  // of full scale at the highest

// The acceleration as 16-bit sound, and a file that says what its full scale is.
void add_sound(const std::string& stem, const SceneTexture& texture, const std::vector<double>& a_mps2,
               const ExportConfig& config, ExportResult& out) {
  double highest_mps2 = 0.0;
  for (const double a : a_mps2) highest_mps2 = std::max(highest_mps2, std::abs(a));
  const double full_scale_mps2 = highest_mps2 > 0.0 ? highest_mps2 / kFullScaleShare : 1.0;
  Json about{{"format", "asperity-sound"},
             {"version", 1},
             {"sound", stem + ".wav"},
             {"full_scale_mps2", full_scale_mps2},
             {"speed_mps", config.stroke.speed_mps},
             {"force_N", config.stroke.force_N},
             {"rate_Hz", config.stroke.rate_Hz}};
  if (!texture.warning.empty()) about["warning"] = texture.warning;
  out.files.push_back({stem + ".wav", format_wav(a_mps2, config.stroke.rate_Hz, full_scale_mps2)});
  out.files.push_back({stem + ".sound.json", about.dump_repaired(2) + "\n"});
}

}  // namespace

void add_vibration(const std::string& stem, const SceneTexture& texture, ExportFormat format,
                   const ExportConfig& config, ExportResult& out) {
  const std::vector<double> a_mps2 = synthesize_stroke(texture.texture, config.stroke);
  if (format == ExportFormat::kWav) {
    add_sound(stem, texture, a_mps2, config, out);
    return;
  }
  const auto points = vibration_envelope(a_mps2, config.stroke.rate_Hz, config.vibration.window_s);
  double highest_mps2 = 0.0;
  std::size_t outside = 0;
  for (const VibrationPoint& point : points) {
    highest_mps2 = std::max(highest_mps2, point.amplitude);
    if (point.frequency_Hz > kSharpnessHigh_Hz || (point.amplitude > 0.0 && point.frequency_Hz < kSharpnessLow_Hz))
      ++outside;
  }
  const double full_scale_mps2 = highest_mps2 > 0.0 ? highest_mps2 : 1.0;
  VibrationNote note{texture_title(texture), ""};
  if (!texture.warning.empty()) note.text = "WARNING: " + texture.warning + ". ";
  note.text += fmt::format(
      "The acceleration of a tool that strokes the texture at {} m/s with {} N; intensity 1 is an amplitude of {} "
      "m/s². asperity.",
      rounded_text(config.stroke.speed_mps), rounded_text(config.stroke.force_N), rounded_text(full_scale_mps2, 6));
  const double duration_s = static_cast<double>(a_mps2.size()) / config.stroke.rate_Hz;
  const bool ahap = format == ExportFormat::kAhap;
  out.problems.push_back({"not_exported",
                          printable(stem) + ": waveform and phases, of which " + (ahap ? "AHAP" : ".haps") +
                              " has amplitude and frequency in windows of " +
                              rounded_text(1e3 * config.vibration.window_s) + " ms only",
                          1});
  if (ahap && outside > 0) {
    out.problems.push_back({"not_exported",
                            fmt::format("{}: {} of {} windows have frequencies outside {} to {} Hz, the range of "
                                        "sharpness; they are at its ends",
                                        printable(stem), outside, points.size(), kSharpnessLow_Hz, kSharpnessHigh_Hz),
                            outside});
  }
  if (ahap) {
    out.files.push_back({stem + ".ahap", format_ahap(points, duration_s, full_scale_mps2, note)});
  } else {
    out.files.push_back({stem + ".haps", format_haps(points, duration_s, full_scale_mps2, note)});
  }
}

}  // namespace asperity

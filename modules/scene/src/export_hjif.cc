#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/scene/format_hjif.h"
#include "asperity/scene/haptic_experience.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/sample_heights.h"
#include "export_parts.h"

namespace asperity {

namespace {

// Values at equal steps; the gain is the greatest of them, so that amplitudes are within −1 and 1.
HapticChannel hjif_channel_of(std::string description, const std::vector<double>& values, std::int64_t step,
                              int highest_frequency) {
  HapticChannel out;
  out.description = std::move(description);
  out.highest_frequency = highest_frequency;
  double highest = 0.0;
  for (const double value : values) highest = std::max(highest, std::abs(value));
  out.gain = highest > 0.0 ? highest : 1.0;
  for (std::size_t i = 0; i < values.size(); ++i)
    out.keyframes.push_back({static_cast<std::int64_t>(i) * step, std::clamp(values[i] / out.gain, -1.0, 1.0)});
  return out;
}

HapticPerception hjif_heights(const std::string& stem, const Texture& texture, const ExportConfig& config,
                              Problems& problems) {
  const std::optional<double> line_mm = line_length_mm(texture.model);
  SampleHeightsConfig line;
  line.length_mm = line_mm ? *line_mm : make_texture_maps(texture, config.images).size_mm.x();
  line.spacing_mm = 1e-3 * config.haptics.spacing_um;
  line.y_mm = line_mm ? 0.0 : 1e3 * config.stroke.y_m;
  // One more height than steps, so that the last is where the texture repeats.
  line.length_mm = std::max(1.0, std::floor(line.length_mm / line.spacing_mm)) * line.spacing_mm;
  SampleHeightsConfig closed = line;
  closed.length_mm += line.spacing_mm;
  HapticPerception out;
  out.modality = HapticModality::kVibrotactileTexture;
  out.description = "heights in m over the path in um";
  out.channels.push_back(hjif_channel_of(
      fmt::format("heights every {} um along {} mm, y = {} mm", config.haptics.spacing_um,
                  rounded_text(line.length_mm, 6), rounded_text(line.y_mm, 6)),
      sample_heights(texture.model, closed), config.haptics.spacing_um, 500000 / config.haptics.spacing_um));
  if (!line_mm) {
    problems.push_back({"not_exported",
                        fmt::format("{}: the surface outside the line y = {} mm; HJIF has curves, not images",
                                    printable(stem), rounded_text(line.y_mm, 6)),
                        1});
  }
  return out;
}

HapticPerception hjif_acceleration(const std::string& stem, const Texture& texture, const ExportConfig& config,
                                   int timescale, Problems& problems) {
  StrokeConfig stroke = config.stroke;
  stroke.rate_Hz = timescale;
  HapticPerception out;
  out.modality = HapticModality::kVibrotactile;
  out.unit_exponent = -3;
  out.description = "acceleration in m/s^2 over ticks of the timescale";
  out.channels.push_back(hjif_channel_of(
      fmt::format("stroked at {} m/s with {} N", rounded_text(stroke.speed_mps), rounded_text(stroke.force_N)),
      synthesize_stroke(texture, stroke), 1, timescale / 2));
  problems.push_back({"not_exported",
                      printable(stem) + ": the model of a force in time; HJIF has one stroke of it, at one speed and "
                                        "force",
                      1});
  return out;
}

}  // namespace

void add_hjif(const std::string& stem, const Scene& scene, const SceneTexture& texture, const ExportConfig& config,
              ExportResult& out) {
  HapticExperience experience;
  experience.description = texture.warning.empty() ? "" : "WARNING: " + printable(texture.warning, 120) + ". ";
  experience.description += "asperity: " + texture_title(texture);
  if (is_height_field(texture.texture.model)) {
    experience.perceptions.push_back(hjif_heights(stem, texture.texture, config, out.problems));
  } else {
    experience.timescale = static_cast<int>(
        std::clamp(std::round(config.stroke.rate_Hz), 1.0, static_cast<double>(kHighestHapticTimescale)));
    experience.perceptions.push_back(
        hjif_acceleration(stem, texture.texture, config, experience.timescale, out.problems));
  }
  if (const auto stiffness = stiffness_of(scene, texture.texture)) {
    const auto depth_um = static_cast<std::int64_t>(std::llround(1e3 * config.haptics.penetration_mm));
    HapticPerception force;
    force.modality = HapticModality::kStiffness;
    force.description = "force in N over penetration in um";
    force.channels.push_back(hjif_channel_of(fmt::format("{} N/m", rounded_text(*stiffness, 6)),
                                             {0.0, *stiffness * 1e-6 * static_cast<double>(depth_um)}, depth_um, 0));
    experience.perceptions.push_back(std::move(force));
  }
  if (const auto friction = friction_of(scene, texture.texture)) {
    HapticPerception rubbing;
    rubbing.modality = HapticModality::kFriction;
    rubbing.description = "coefficient of sliding friction over the path in um";
    rubbing.channels.push_back(hjif_channel_of("the same everywhere", {*friction, *friction}, kLongestHapticEffect, 0));
    experience.perceptions.push_back(std::move(rubbing));
  }
  const bool sticks = texture.texture.static_friction_ratio || scene.static_friction_ratio;
  if (sticks)
    out.problems.push_back({"not_exported", printable(stem) + ": the coefficient of sticking; HJIF has one", 1});
  if (texture.texture.compliance_kc)
    out.problems.push_back({"not_exported", printable(stem) + ": the compliance k_c; HJIF has stiffness", 1});
  out.files.push_back({stem + ".hjif", format_hjif(experience)});
}

}  // namespace asperity

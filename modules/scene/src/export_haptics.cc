#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/scene/format_hjif.h"
#include "asperity/scene/format_hmpg.h"
#include "asperity/scene/haptic_experience.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/sample_heights.h"
#include "export_parts.h"
#include "hmpg_layout.h"

namespace asperity {

namespace {

// Values at equal steps; the gain is the greatest of them, so that amplitudes are within −1 and 1.
HapticChannel channel_of(std::string description, const std::vector<double>& values, std::int64_t step,
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

HapticPerception heights_along(const std::string& stem, const Texture& texture, const ExportConfig& config,
                               const std::string& format, Problems& problems) {
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
  out.channels.push_back(channel_of(fmt::format("heights every {} um along {} mm, y = {} mm", config.haptics.spacing_um,
                                                rounded_text(line.length_mm, 6), rounded_text(line.y_mm, 6)),
                                    sample_heights(texture.model, closed), config.haptics.spacing_um,
                                    500000 / config.haptics.spacing_um));
  if (!line_mm) {
    problems.push_back({"not_exported",
                        fmt::format("{}: the surface outside the line y = {} mm; {} has curves, not images",
                                    printable(stem), rounded_text(line.y_mm, 6), format),
                        1});
  }
  return out;
}

HapticPerception acceleration_of(const std::string& stem, const Texture& texture, const ExportConfig& config,
                                 int timescale, const std::string& format, Problems& problems) {
  StrokeConfig stroke = config.stroke;
  stroke.rate_Hz = timescale;
  HapticPerception out;
  out.modality = HapticModality::kVibrotactile;
  out.unit_exponent = -3;
  out.description = "acceleration in m/s^2 over ticks of the timescale";
  out.channels.push_back(channel_of(
      fmt::format("stroked at {} m/s with {} N", rounded_text(stroke.speed_mps), rounded_text(stroke.force_N)),
      synthesize_stroke(texture, stroke), 1, timescale / 2));
  problems.push_back(
      {"not_exported",
       printable(stem) + ": the model of a force in time; " + format + " has one stroke of it, at one speed and force",
       1});
  return out;
}

std::optional<HapticPerception> stiffness_line(const Scene& scene, const Texture& texture, const ExportConfig& config) {
  const auto stiffness = stiffness_of(scene, texture);
  if (!stiffness) return std::nullopt;
  const auto depth_um = static_cast<std::int64_t>(std::llround(1e3 * config.haptics.penetration_mm));
  HapticPerception out;
  out.modality = HapticModality::kStiffness;
  out.description = "force in N over penetration in um";
  out.channels.push_back(channel_of(fmt::format("{} N/m", rounded_text(*stiffness, 6)),
                                    {0.0, *stiffness * 1e-6 * static_cast<double>(depth_um)}, depth_um, 0));
  return out;
}

std::optional<HapticPerception> friction_line(const Scene& scene, const Texture& texture) {
  const auto friction = friction_of(scene, texture);
  if (!friction) return std::nullopt;
  HapticPerception out;
  out.modality = HapticModality::kFriction;
  out.description = "coefficient of sliding friction over the path in um";
  out.channels.push_back(channel_of("the same everywhere", {*friction, *friction}, kLongestHapticEffect, 0));
  return out;
}

HapticExperience experience_of(const std::string& stem, const Scene& scene, const SceneTexture& texture,
                               const ExportConfig& config, const std::string& format, Problems& problems) {
  HapticExperience out;
  out.description = texture.warning.empty() ? "" : "WARNING: " + printable(texture.warning, 120) + ". ";
  out.description += "asperity: " + texture_title(texture);
  if (is_height_field(texture.texture.model)) {
    out.perceptions.push_back(heights_along(stem, texture.texture, config, format, problems));
  } else {
    out.timescale = static_cast<int>(
        std::clamp(std::round(config.stroke.rate_Hz), 1.0, static_cast<double>(kHighestHapticTimescale)));
    out.perceptions.push_back(acceleration_of(stem, texture.texture, config, out.timescale, format, problems));
  }
  if (auto force = stiffness_line(scene, texture.texture, config)) out.perceptions.push_back(*std::move(force));
  if (auto rubbing = friction_line(scene, texture.texture)) out.perceptions.push_back(*std::move(rubbing));
  const bool sticks = texture.texture.static_friction_ratio || scene.static_friction_ratio;
  if (sticks)
    problems.push_back({"not_exported", printable(stem) + ": the coefficient of sticking; " + format + " has one", 1});
  if (texture.texture.compliance_kc)
    problems.push_back({"not_exported", printable(stem) + ": the compliance k_c; " + format + " has stiffness", 1});
  return out;
}

// The values that HMPG's 8 bits and its limit of frequencies change.
void add_hmpg_losses(const std::string& stem, const HapticExperience& experience, Problems& problems) {
  struct Quantity {
    const char* name;
    double per_si;
    const char* unit;
  };
  constexpr std::array<Quantity, 4> kQuantities{{{"accelerations", 1.0, " m/s\u00b2"},
                                                 {"heights", 1e6, " \u00b5m"},
                                                 {"forces", 1.0, " N"},
                                                 {"friction", 1.0, ""}}};
  for (const HapticPerception& perception : experience.perceptions) {
    const Quantity& quantity = kQuantities[static_cast<std::size_t>(perception.modality)];
    for (const HapticChannel& channel : perception.channels) {
      const double error = hmpg_value_error(perception, channel);
      if (error > 1e-5 * channel.gain) {  // else it is that of a gain alone
        problems.push_back({"not_exported",
                            fmt::format("{}: {} to about {}{}; HMPG has 8 bits for a value", printable(stem),
                                        quantity.name, rounded_text(quantity.per_si * error), quantity.unit),
                            1});
      }
      if (channel.highest_frequency > kHighestHmpgFrequency) {
        problems.push_back({"not_exported",
                            fmt::format("{}: the frequency limit {}; HMPG has at most {}", printable(stem),
                                        channel.highest_frequency, kHighestHmpgFrequency),
                            1});
      }
    }
  }
}

}  // namespace

void add_haptics(const std::string& stem, const Scene& scene, const SceneTexture& texture, ExportFormat format,
                 const ExportConfig& config, ExportResult& out) {
  if (format == ExportFormat::kHjif) {
    out.files.push_back(
        {stem + ".hjif", format_hjif(experience_of(stem, scene, texture, config, "HJIF", out.problems))});
    return;
  }
  const HapticExperience experience = experience_of(stem, scene, texture, config, "HMPG", out.problems);
  out.files.push_back({stem + ".hmpg", format_hmpg(experience)});
  add_hmpg_losses(stem, experience, out.problems);
}

}  // namespace asperity

#include "texture_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"

namespace asperity::app {

namespace {

struct LabelledUnit {
  std::string_view key, label, unit;
  double factor = 1.0;
  std::string_view between = " x ";  // two numbers
};

constexpr std::array kLabels{
    LabelledUnit{"length_mm", "Length", "mm"},
    LabelledUnit{"harmonics", "Harmonics", ""},
    LabelledUnit{"mean_m", "Mean height", "µm", 1e6},
    LabelledUnit{"kind", "Kind", ""},
    LabelledUnit{"seed", "Seed", ""},
    LabelledUnit{"columns", "Columns", ""},
    LabelledUnit{"rows", "Rows", ""},
    LabelledUnit{"spacing_m", "Spacing", "mm", 1e3},
    LabelledUnit{"supported_part", "Measured share", "%", 100.0},
    LabelledUnit{"border", "Border", ""},
    LabelledUnit{"sigma_rms_m", "Standard deviation", "µm RMS", 1e6},
    LabelledUnit{"rate_Hz", "Sampling rate", "Hz"},
    LabelledUnit{"models", "Models", ""},
    LabelledUnit{"order", "Order of a model", ""},
    LabelledUnit{"triangles", "Triangles", ""},
    LabelledUnit{"mass_kg", "Mass of the tool", "g", 1e3},
    LabelledUnit{"a_per_s", "Coefficient a", "1/s"},
    LabelledUnit{"b_per_kg", "Coefficient b", "1/kg"},
    LabelledUnit{"decay_per_s", "Decay rate", "1/s"},
    LabelledUnit{"omega_rad_per_s", "Frequency", "Hz", 0.5 / std::numbers::pi},
    LabelledUnit{"pitch_m", "Pitch", "mm", 1e3},
    LabelledUnit{"bits", "Bits per pixel", ""},
    LabelledUnit{"mm_per_px", "Pixel size", "mm"},
    LabelledUnit{"low_m", "Lowest height", "µm", 1e6},
    LabelledUnit{"high_m", "Highest height", "µm", 1e6},
    LabelledUnit{"quantisation_m", "Height of one level", "µm", 1e6},
    LabelledUnit{"sigma_m", "Height", "µm RMS", 1e6},
    LabelledUnit{"correlation_length_m", "Correlation length", "mm", 1e3},
    LabelledUnit{"stiffness_N_per_m", "Stiffness", "N/mm", 1e-3},
    LabelledUnit{"Ra_m", "Ra", "µm", 1e6},
    LabelledUnit{"Rq_m", "Rq", "µm", 1e6},
    LabelledUnit{"Rt_m", "Rt", "µm", 1e6},
    LabelledUnit{"RSm_m", "RSm", "µm", 1e6},
    LabelledUnit{"lift_m", "Height offset", "µm", 1e6},
    LabelledUnit{"band_cycles_per_mm", "Band", "cycles/mm", 1.0, " to "},
    LabelledUnit{"compliance_kc", "Compliance k_c", ""},
    LabelledUnit{"friction", "Friction coefficient", ""},
    LabelledUnit{"static_friction_ratio", "Sticking over sliding", ""},
    LabelledUnit{"rms_error_m", "Error of the model", "µm RMS", 1e6},
};

struct UnitEnding {
  std::string_view ending, unit;
};
// The longer before those that they end with.
constexpr std::array kEndings{
    UnitEnding{"_cycles_per_mm", "cycles/mm"},
    UnitEnding{"_rad_per_mm", "rad/mm"},
    UnitEnding{"_rad_per_s", "rad/s"},
    UnitEnding{"_N_per_m", "N/m"},
    UnitEnding{"_per_kg", "1/kg"},
    UnitEnding{"_per_s", "1/s"},
    UnitEnding{"_per_m", "1/m"},
    UnitEnding{"_mps", "m/s"},
    UnitEnding{"_rad", "rad"},
    UnitEnding{"_kg", "kg"},
    UnitEnding{"_Hz", "Hz"},
    UnitEnding{"_mm", "mm"},
    UnitEnding{"_um", "µm"},
    UnitEnding{"_m", "m"},
    UnitEnding{"_N", "N"},
    UnitEnding{"_s", "s"},
};

std::string spelt_out(std::string_view key) {
  std::string out(key);
  std::replace(out.begin(), out.end(), '_', ' ');
  if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 'a' + 'A');
  return out;
}

std::string number_of(const Json& value, double factor) {
  if (!value.is_number()) return value.is_string() ? printable(value.get<std::string>(), 100) : value.dump();
  const double number = value.get<double>();
  return factor == 1.0 && value.is_number_integer() ? value.dump() : rounded_text(factor * number, 4);
}

}  // namespace

std::string texture_line(std::string_view key, const Json& value) {
  if (value.is_object()) {
    std::string out;
    for (const auto& [inner, one] : value.items()) {
      std::string line = texture_line(inner, one);
      out += "  " + std::string(key) + ":" + line.substr(1);
    }
    return out;
  }
  std::string label, unit;
  double factor = 1.0;
  std::string_view between = ", ";
  const auto found = std::find_if(kLabels.begin(), kLabels.end(), [key](const auto& one) { return one.key == key; });
  if (found != kLabels.end()) {
    label = found->label;
    unit = found->unit;
    factor = found->factor;
    between = found->between;
  } else {
    const auto ending =
        std::find_if(kEndings.begin(), kEndings.end(), [key](const auto& one) { return key.ends_with(one.ending); });
    if (ending != kEndings.end()) unit = ending->unit;
    label = spelt_out(key.substr(0, key.size() - (ending != kEndings.end() ? ending->ending.size() : 0)));
  }
  std::string text;
  if (value.is_array()) {
    for (const Json& one : value) text += (text.empty() ? "" : std::string(between)) + number_of(one, factor);
  } else {
    text = number_of(value, factor);
  }
  return fmt::format("  {:<22} {}{}{}\n", label, text, unit.empty() ? "" : " ", unit);
}

}  // namespace asperity::app

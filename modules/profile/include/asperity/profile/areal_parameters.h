#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "asperity/base/nan.h"

namespace asperity {

// Parameters of a scale-limited surface by ISO 25178-2:2021, heights from its mean; docs/roughness-areal.md has the
// formulas. A parameter that the surface does not define is nan.
struct ArealParameters {
  double Sa_m = kNan;
  double Sq_m = kNan;
  double Sz_m = kNan;  // Sp + Sv
  double Sp_m = kNan;
  double Sv_m = kNan;
  double Ssk = kNan;
  double Sku = kNan;
  double Sdq = kNan;      // root mean square slope
  double Sdr = kNan;      // developed area over area, less 1
  double Sal_m = kNan;    // shortest distance at which the autocorrelation falls to 0.2
  double Str = kNan;      // over the longest; near 0 with a lay, 1 without
  double Std_rad = kNan;  // direction of the lay from x towards y, 0 to π; nan where Str is above 0.5
  double Sk_m = kNan;
  double Spk_m = kNan;
  double Svk_m = kNan;
  double Smrk1 = kNan;
  double Smrk2 = kNan;
  double Sxp_m = kNan;  // fall of the material ratio curve from 2.5 to 50 %
  double Vmp_m = kNan;  // volumes over area
  double Vmc_m = kNan;
  double Vvc_m = kNan;
  double Vvv_m = kNan;
};

enum class ArealQuantity { kHeight, kAlong, kNumber, kSlope, kRatio, kAngle };

struct ArealParameter {
  std::string_view name;
  std::string_view key;  // in files: with its unit
  double ArealParameters::*value;
  ArealQuantity quantity = ArealQuantity::kHeight;
  bool hangs_on_extremes = false;  // on single heights, or high powers of them
};

inline constexpr std::array<ArealParameter, 22> kArealParameters{{
    {"Sa", "Sa_m", &ArealParameters::Sa_m},
    {"Sq", "Sq_m", &ArealParameters::Sq_m},
    {"Sz", "Sz_m", &ArealParameters::Sz_m, ArealQuantity::kHeight, true},
    {"Sp", "Sp_m", &ArealParameters::Sp_m, ArealQuantity::kHeight, true},
    {"Sv", "Sv_m", &ArealParameters::Sv_m, ArealQuantity::kHeight, true},
    {"Ssk", "Ssk", &ArealParameters::Ssk, ArealQuantity::kNumber, true},
    {"Sku", "Sku", &ArealParameters::Sku, ArealQuantity::kNumber, true},
    {"Sdq", "Sdq", &ArealParameters::Sdq, ArealQuantity::kSlope},
    {"Sdr", "Sdr", &ArealParameters::Sdr, ArealQuantity::kRatio},
    {"Sal", "Sal_m", &ArealParameters::Sal_m, ArealQuantity::kAlong},
    {"Str", "Str", &ArealParameters::Str, ArealQuantity::kNumber},
    {"Std", "Std_rad", &ArealParameters::Std_rad, ArealQuantity::kAngle},
    {"Sk", "Sk_m", &ArealParameters::Sk_m},
    {"Spk", "Spk_m", &ArealParameters::Spk_m, ArealQuantity::kHeight, true},
    {"Svk", "Svk_m", &ArealParameters::Svk_m, ArealQuantity::kHeight, true},
    {"Smrk1", "Smrk1", &ArealParameters::Smrk1, ArealQuantity::kRatio},
    {"Smrk2", "Smrk2", &ArealParameters::Smrk2, ArealQuantity::kRatio},
    {"Sxp", "Sxp_m", &ArealParameters::Sxp_m},
    {"Vmp", "Vmp_m", &ArealParameters::Vmp_m, ArealQuantity::kHeight, true},
    {"Vmc", "Vmc_m", &ArealParameters::Vmc_m},
    {"Vvc", "Vvc_m", &ArealParameters::Vvc_m},
    {"Vvv", "Vvv_m", &ArealParameters::Vvv_m, ArealQuantity::kHeight, true},
}};

}  // namespace asperity

#include "asperity/profile/rounding_floor.h"

#include <fmt/format.h>

#include "asperity/base/nan.h"

namespace asperity {
namespace {

enum class Level { kAbove, kLastDigit, kFlat };

Level level_of(const HeightsOrigin& origin, double rms_m) {
  if (rms_m <= origin.arithmetic_rms_m) return Level::kFlat;
  return rms_m <= origin.last_digit_rms_m * (1.0 - 1e-9) ? Level::kLastDigit : Level::kAbove;
}

std::string sentence(const HeightsOrigin& origin, const std::string& name, double rms_m, Level level) {
  if (level == Level::kAbove) return {};
  if (level == Level::kFlat) return "the heights are flat to the last digit: the shape of a texture is not determined";
  return fmt::format("{} {:.2g} µm is within the rounding of the file's numbers ({:.2g} µm RMS): not determined", name,
                     1e6 * rms_m, 1e6 * origin.last_digit_rms_m);
}

// `zero` where the quantity grows with the heights.
double floor_value(Level level, bool zero) { return level == Level::kFlat && zero ? 0.0 : kNan; }

void apply(Level level, ProfileParametersResult& out) {
  if (level == Level::kAbove) return;
  for (const ProfileParameter& p : kProfileParameters) {
    const bool zero = p.quantity == ProfileQuantity::kHeight || p.quantity == ProfileQuantity::kSlope;
    if (p.value != &ProfileParameters::dl_m) out.*p.value = floor_value(level, zero);
    out.standard_error.*p.value = kNan;
  }
}

}  // namespace

std::string apply_rounding_floor(const HeightsOrigin& origin, RoughnessResult& result) {
  const double rms_m = result.Rq_m;
  const Level level = level_of(origin, rms_m);
  if (level == Level::kAbove) return {};
  for (const RoughnessParameter& p : kRoughnessParameters)
    result.*p.value = floor_value(level, p.is_length && p.value != &RoughnessParameters::RSm_m);
  result.standard_error = RoughnessParameters::unknown();
  return sentence(origin, "Rq", rms_m, level);
}

std::string apply_rounding_floor(const HeightsOrigin& origin, ProfileTexture& texture) {
  const double rms_m = texture.P.q_m;
  const Level of_P = level_of(origin, rms_m);
  apply(of_P, texture.P);
  if (!texture.R) return sentence(origin, "Pq", rms_m, of_P);
  const double rough_m = texture.R->q_m;
  const Level of_R = level_of(origin, rough_m);
  apply(of_R, *texture.R);
  if (texture.W && of_R != Level::kAbove) apply(level_of(origin, texture.W->q_m), *texture.W);
  return sentence(origin, "Rq", rough_m, of_R);
}

std::string apply_rounding_floor(const HeightsOrigin& origin, ArealParameters& parameters) {
  const double rms_m = parameters.Sq_m;
  const Level level = level_of(origin, rms_m);
  if (level == Level::kAbove) return {};
  for (const ArealParameter& p : kArealParameters) {
    const bool zero = p.quantity == ArealQuantity::kHeight || p.quantity == ArealQuantity::kSlope;
    parameters.*p.value = floor_value(level, zero);
  }
  return sentence(origin, "Sq", rms_m, level);
}

}  // namespace asperity

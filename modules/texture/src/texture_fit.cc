#include "asperity/texture/texture_fit.h"

#include "asperity/base/plausible_profile.h"

namespace asperity {

namespace {

HeightLine checked(HeightLine line) {
  require_plausible_spacing(line.spacing_m, "texture");
  require_plausible_heights(line.height_m, "texture");
  require_unequal("heights", line.height_m, "texture");
  return line;
}

std::vector<ArealSample> checked(std::vector<ArealSample> samples) {
  std::vector<double> height_m;
  for (const ArealSample& sample : samples) height_m.push_back(sample.height_m);
  require_unequal("heights", height_m, "texture");
  return samples;
}

SeriesTable checked(SeriesTable table) {
  require_unequal("accelerations", table.acceleration_mps2, "texture");
  return table;
}

// The same reader, which refuses what no texture can be fitted to.
template <class Out, class In>
std::function<Out(const In&)> with_check(const std::function<Out(const In&)>& read) {
  if (!read) return read;
  return [read](const In& files) { return checked(read(files)); };
}

}  // namespace

FittedTexture fit_texture(FittedModelChoice choice, const TextureFitInput& given, const TextureFitOptions& options) {
  TextureFitInput input = given;
  input.read_heights = with_check(given.read_heights);
  input.read_areal_samples = with_check(given.read_areal_samples);
  input.read_series = with_check(given.read_series);
  input.read_recording_or_series = with_check(given.read_recording_or_series);
  FittedTexture out;
  auto k = static_cast<int>(choice);
  for_each_texture_model([&]<class Model>() {
    if constexpr (FittedModel<Model>) {
      if (k-- == 0) TextureModelTraits<Model>::fit(input, options, out);
    }
  });
  return out;
}

}  // namespace asperity

#include "flat_block.h"

namespace asperity {
namespace {

template <class Model, class Field>
void list_stochastic(Model& t, const Field& field) {
  field("sigma_m", t.sigma_m, 0.0, kLargestHeight_m);
  field("correlation_length_m", t.correlation_length_m, 0.0, kLargestHeight_m);
  field("tangential_ratio", t.tangential_ratio, -100.0, 100.0);
  field("lift_sigma", t.offset_sigmas, 0.0, 10.0);
  field("stiffness_N_per_m", t.stiffness_N_per_m, 0.0, 1e6);
  field("mass_kg", t.mass_kg, 1e-6, 1e3);
  field("reference_speed_mps", t.reference_speed_mps, 1e-6, 1e3);
  field("speed_exponent", t.speed_exponent, -10.0, 10.0);
  field("reference_force_N", t.reference_force_N, 1e-6, 1e6);
  field("force_exponent", t.force_exponent, -10.0, 10.0);
  field("fade_speed_mps", t.fade_speed_mps, 0.0, 1e3);
}

}  // namespace

void TextureModelTraits<StochasticTexture>::read_block(const BlockInput& input, StochasticTexture& t) {
  const FlatReader read{input};
  input.block.required("sigma_m");
  read("grain_m", t.correlation_length_m, 0.0, kLargestHeight_m);  // its former name
  list_stochastic(t, read);
  input.block.finish();
}

std::string TextureModelTraits<StochasticTexture>::write_block(const StochasticTexture& t, BlockOutput&) {
  JsonWriter block = block_writer();
  list_stochastic(t, FlatWriter{block});
  return block.take();
}

}  // namespace asperity

#include "flat_block.h"

namespace asperity {
namespace {

template <class Model, class Field>
void list_decaying_sinusoids(Model& t, const Field& field) {
  field("a_per_s", t.a_per_s, -1e9, 1e9);
  field("b_per_kg", t.b_per_kg, -1e9, 1e9);
  field("decay_per_s", t.decay_per_s, 0.0, 1e7);
  field("omega_rad_per_s", t.omega_rad_per_s, 0.0, 1e7);
  field("mass_kg", t.mass_kg, 0.0, 1e3);
  field("tangential_ratio", t.tangential_ratio, -100.0, 100.0);
  field("pitch_m", t.pitch_m, 0.0, 1e3);
}

}  // namespace

void TextureModelTraits<DecayingSinusoids>::read_block(const BlockInput& input, DecayingSinusoids& t) {
  for (const char* key : {"a_per_s", "b_per_kg", "decay_per_s", "omega_rad_per_s"}) input.block.required(key);
  list_decaying_sinusoids(t, FlatReader{input});
  input.block.finish();
}

std::string TextureModelTraits<DecayingSinusoids>::write_block(const DecayingSinusoids& t, BlockOutput&) {
  JsonWriter block = block_writer();
  list_decaying_sinusoids(t, FlatWriter{block});
  return block.take();
}

}  // namespace asperity

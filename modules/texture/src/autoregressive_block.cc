#include <algorithm>
#include <cmath>

#include "asperity/texture/series_state.h"
#include "flat_block.h"

namespace asperity {
namespace {

template <class Model, class Field>
void list_autoregressive(Model& t, const Field& field) {
  field("rate_Hz", t.rate_Hz, 1.0, 1e6);
  field("mass_kg", t.mass_kg, 0.0, 1e3);
  field("tangential_ratio", t.tangential_ratio, -1e3, 1e3);
  field("lift_sigma", t.offset_sigmas, 0.0, 10.0);
  field("fade_speed_mps", t.fade_speed_mps, 0.0, 1e3);
  field("fade_force_N", t.fade_force_N, 0.0, 1e6);
  field("max_speed_mps", t.max_speed_mps, 0.0, 1e3);
  field("max_force_N", t.max_force_N, 0.0, 1e6);
}

// One list for all models: those of a list come one after another.
std::vector<double> lsf_list(const JsonItem& in, std::size_t models) {
  auto all = in.numbers(kMostCoefficients, {-4.0, 4.0});
  if (all.size() % models != 0 || all.size() / models > static_cast<std::size_t>(kMaxSeriesOrder)) {
    in.fail(std::to_string(all.size()) + " numbers for " + std::to_string(models) + " models of an order of at most " +
            std::to_string(kMaxSeriesOrder));
  }
  return all;
}

void read_triangles(const JsonItem& in, AutoregressiveTexture& t) {
  auto all = in.numbers(kMostCoefficients, {-1e6, 1e6});
  if (all.size() % 3 != 0) in.fail(std::to_string(all.size()) + " numbers are not triangles, which have three each");
  for (std::size_t i = 0; i < all.size(); i += 3) {
    std::array<int, 3> triangle;
    for (std::size_t j = 0; j < 3; ++j) {
      if (all[i + j] != std::floor(all[i + j])) in.element(i + j).fail(number_text(all[i + j]) + " is not an index");
      triangle[j] = static_cast<int>(all[i + j]);
    }
    t.triangles.push_back(triangle);
  }
}

}  // namespace

void TextureModelTraits<AutoregressiveTexture>::read_block(const BlockInput& in, AutoregressiveTexture& t) {
  JsonObject& block = in.block;
  block.required("rate_Hz");
  list_autoregressive(t, FlatReader{in});
  const auto speed = block.required("speed_mps").numbers(kMaxSeriesModels, {-1e3, 1e3});
  const std::size_t models = speed.size();
  if (models == 0) block.fail("speed_mps", "is empty");
  const auto column = [&](const char* key, double largest) {
    auto values = block.required(key).numbers(kMaxSeriesModels, {-largest, largest});
    if (values.size() != models) {
      block.fail(key, std::to_string(values.size()) + " numbers where speed_mps has " + std::to_string(models));
    }
    return values;
  };
  const auto force = column("force_N", 1e6);
  const auto gain = column("gain", 1e6);
  const auto variance = column("variance_m2_per_s4", 1e12);
  const auto ar = lsf_list(block.required("ar_lsf_rad"), models);
  const auto ma_list = block.optional("ma_lsf_rad");
  const auto ma = ma_list ? lsf_list(*ma_list, models) : std::vector<double>();
  const auto row = [models](const std::vector<double>& all, std::size_t i) {
    const auto order = static_cast<std::ptrdiff_t>(all.size() / models);
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(i) * order;
    return std::vector<double>(first, first + order);
  };
  for (std::size_t i = 0; i < models; ++i)
    t.models.push_back({speed[i], force[i], row(ar, i), row(ma, i), gain[i], variance[i]});
  if (const auto triangles = block.optional("triangles")) read_triangles(*triangles, t);
  block.finish();
  try {
    prepare_autoregressive(t, "the models");
  } catch (const Error& error) {
    block.item().fail(error.what());
  }
}

std::string TextureModelTraits<AutoregressiveTexture>::write_block(const AutoregressiveTexture& texture, BlockOutput&) {
  AutoregressiveTexture t = texture;
  prepare_autoregressive(t, "texture");
  JsonWriter block = block_writer();
  list_autoregressive(t, FlatWriter{block});
  std::vector<double> speed, force, gain, variance, ar, ma, triangles;
  for (const auto& m : t.models) {
    speed.push_back(m.speed_mps);
    force.push_back(m.force_N);
    gain.push_back(m.gain);
    variance.push_back(m.variance);
    ar.insert(ar.end(), m.ar_lsf_rad.begin(), m.ar_lsf_rad.end());
    ma.insert(ma.end(), m.ma_lsf_rad.begin(), m.ma_lsf_rad.end());
  }
  for (const auto& triangle : t.triangles) triangles.insert(triangles.end(), triangle.begin(), triangle.end());
  block.numbers("speed_mps", speed);
  block.numbers("force_N", force);
  block.numbers("gain", gain);
  block.numbers("variance_m2_per_s4", variance);
  block.numbers("ar_lsf_rad", ar);
  if (!ma.empty()) block.numbers("ma_lsf_rad", ma);
  if (!triangles.empty()) block.numbers("triangles", triangles);
  return block.take();
}

}  // namespace asperity

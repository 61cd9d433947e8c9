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
  field("lift_sigma", t.lift_sigma, 0.0, 10.0);
  field("fade_speed_mps", t.fade_speed_mps, 0.0, 1e3);
  field("fade_force_N", t.fade_force_N, 0.0, 1e6);
  field("max_speed_mps", t.max_speed_mps, 0.0, 1e3);
  field("max_force_N", t.max_force_N, 0.0, 1e6);
}

// One list for all models: those of a list come one after another.
std::vector<double> lsf_list(const BlockInput& in, const char* key, std::size_t models) {
  auto all = required_numbers(in.json, in.path, key, 4.0);
  if (all.size() % models != 0 || all.size() / models > static_cast<std::size_t>(kMaxSeriesOrder)) {
    in.json.fail(in.path + "." + key, std::to_string(all.size()) + " numbers for " + std::to_string(models) +
                                          " models of an order of at most " + std::to_string(kMaxSeriesOrder));
  }
  return all;
}

void read_triangles(const BlockInput& in, AutoregressiveTexture& t) {
  auto all = required_numbers(in.json, in.path, "triangles", 1e6);
  const std::string path = in.path + ".triangles";
  if (all.size() % 3 != 0) in.json.fail(path, std::to_string(all.size()) + " numbers are no triangles");
  for (std::size_t i = 0; i < all.size(); i += 3) {
    std::array<int, 3> triangle;
    for (std::size_t j = 0; j < 3; ++j) {
      if (all[i + j] != std::floor(all[i + j]))
        in.json.fail(path + "[" + std::to_string(i + j) + "]", number_text(all[i + j]) + " is no index");
      triangle[j] = static_cast<int>(all[i + j]);
    }
    t.triangles.push_back(triangle);
  }
}

}  // namespace

void TextureModelTraits<AutoregressiveTexture>::read_block(const BlockInput& in, AutoregressiveTexture& t) {
  in.json.only(in.path, {"rate_Hz", "mass_kg", "tangential_ratio", "lift_sigma", "fade_speed_mps", "fade_force_N",
                         "max_speed_mps", "max_force_N", "speed_mps", "force_N", "gain", "variance_m2_per_s4",
                         "ar_lsf_rad", "ma_lsf_rad", "triangles"});
  in.json.require(in.path, "rate_Hz");
  list_autoregressive(t, FlatReader{in});
  const auto speed = required_numbers(in.json, in.path, "speed_mps", 1e3, kMaxSeriesModels);
  const std::size_t models = speed.size();
  if (models == 0) in.json.fail(in.path + ".speed_mps", "is empty");
  const auto column = [&](const char* key, double largest) {
    auto values = required_numbers(in.json, in.path, key, largest, kMaxSeriesModels);
    if (values.size() != models) {
      in.json.fail(in.path + "." + key,
                   std::to_string(values.size()) + " numbers where speed_mps has " + std::to_string(models));
    }
    return values;
  };
  const auto force = column("force_N", 1e6);
  const auto gain = column("gain", 1e6);
  const auto variance = column("variance_m2_per_s4", 1e12);
  const auto ar = lsf_list(in, "ar_lsf_rad", models);
  const auto ma = in.json.find(in.path, "ma_lsf_rad") ? lsf_list(in, "ma_lsf_rad", models) : std::vector<double>();
  const auto row = [models](const std::vector<double>& all, std::size_t i) {
    const auto order = static_cast<std::ptrdiff_t>(all.size() / models);
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(i) * order;
    return std::vector<double>(first, first + order);
  };
  for (std::size_t i = 0; i < models; ++i)
    t.models.push_back({speed[i], force[i], row(ar, i), row(ma, i), gain[i], variance[i]});
  if (in.json.find(in.path, "triangles")) read_triangles(in, t);
  try {
    prepare_autoregressive(t, "the models");
  } catch (const Error& error) {
    in.json.fail(in.path, error.what());
  }
}

std::string TextureModelTraits<AutoregressiveTexture>::write_block(const AutoregressiveTexture& texture, BlockOutput&) {
  AutoregressiveTexture t = texture;
  prepare_autoregressive(t, "texture");
  BlockText block;
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
  block.add("speed_mps", speed).add("force_N", force).add("gain", gain).add("variance_m2_per_s4", variance);
  block.add("ar_lsf_rad", ar);
  if (!ma.empty()) block.add("ma_lsf_rad", ma);
  if (!triangles.empty()) block.add("triangles", triangles);
  return block.str();
}

}  // namespace asperity

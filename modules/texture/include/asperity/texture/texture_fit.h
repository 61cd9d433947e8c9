#pragma once

#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/problem.h"
#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/texture/texture.h"

namespace asperity {

// Heights along a line, nan in gaps.
struct HeightLine {
  std::vector<double> height_m;
  double spacing_m = 0.0;
};

// A tool's acceleration over a texture with the speed and force it had, sampled evenly.
struct SeriesTable {
  std::vector<double> acceleration_mps2;
  std::vector<double> speed_mps;
  std::vector<double> force_N;
  double rate_Hz = 0.0;
};

// What a texture is fitted to. A model asks for what it is made of, which is read then; the readers throw Error naming
// the file.
struct TextureFitInput {
  std::vector<std::string> files;
  Observer observer{};      // may cancel the fits of series and areal maps
  bool whole_path = false;  // one series over the whole path instead of its best window
  std::function<HeightLine(const std::vector<std::string>& files)> read_heights;
  std::function<std::vector<ArealSample>(const std::vector<std::string>& files)> read_areal_samples;
  std::function<SeriesTable(const std::string& file)> read_series;
  std::function<SeriesTable(const std::string& file)> read_recording_or_series;
  std::function<bool(const std::string& file)> is_texture_file;
  // The period of the heights along a line, 0 if they have none; unset: not looked for.
  std::function<double(const std::vector<std::string>& files)> pitch_m;
  // Ra_m, Rq_m, … of lines of heights `spacing_m` apart.
  std::function<std::map<std::string, double>(const std::vector<std::vector<double>>& lines_m, double spacing_m)>
      roughness;
};

// More, or other, files than the model is made of.
class TextureFitFilesError : public Error {
 public:
  using Error::Error;
};

// A texture and what its fit says of it.
struct FittedTexture {
  Texture texture;
  Json report;
  Problems problems;

  void add_problems(const Problems& more) { problems.insert(problems.end(), more.begin(), more.end()); }
};

namespace detail {

template <class Model>
struct FitOptionsOf {
  using Type = std::tuple<>;
};
template <FittedModel Model>
struct FitOptionsOf<Model> {
  using Type = std::tuple<typename TextureModelTraits<Model>::FitOptions>;
};
template <class Variant>
struct AllFitOptions;
template <class... Models>
struct AllFitOptions<std::variant<Models...>> {
  using Type = decltype(std::tuple_cat(std::declval<typename FitOptionsOf<Models>::Type>()...));
};

}  // namespace detail

// The settings of all models' fits, each in its own groups, in the order of the models.
struct TextureFitOptions {
  detail::AllFitOptions<TextureModel>::Type all;

  template <class Model>
  const auto& of() const {
    return std::get<typename TextureModelTraits<Model>::FitOptions>(all);
  }

  template <class V>
  void visit(V& v) {
    std::apply([&](auto&... options) { (options.visit(v), ...); }, all);
  }
};

// The models that have a fit, counted in the order of the models; the names are those of the files.
enum class FittedModelChoice : int {};
inline constexpr std::size_t kFittedModelCount = std::tuple_size_v<detail::AllFitOptions<TextureModel>::Type>;
inline constexpr auto kFittedModelNames = [] {
  std::array<std::string_view, kFittedModelCount> names;
  std::size_t k = 0;
  for_each_texture_model([&]<class Model>() {
    if constexpr (FittedModel<Model>) names[k++] = TextureModelTraits<Model>::kName;
  });
  return names;
}();

// Fits a texture of the chosen model: its model, and what of band, roughness and friction the input says. Throws Error
// as the readers and the fits do, TextureFitFilesError for files that the model is not made of.
FittedTexture fit_texture(FittedModelChoice choice, const TextureFitInput& input, const TextureFitOptions& options);

}  // namespace asperity

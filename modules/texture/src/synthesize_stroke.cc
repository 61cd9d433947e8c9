#include "asperity/texture/synthesize_stroke.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/evaluate_height.h"

namespace asperity {
namespace {

constexpr double kMostSamples = 268435456.0;  // 2^28

std::size_t samples_of(const StrokeConfig& c) {
  const auto check = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      throw Error(std::string("stroke: ") + what + " " + number_text(value) + " is not within " + number_text(low) +
                  " and " + number_text(high));
    }
  };
  check("speed_mps", c.speed_mps, 0.0, 10.0);
  check("force_N", c.force_N, 0.0, 100.0);
  check("rate_Hz", c.rate_Hz, 1.0, 1e6);
  check("duration_s", c.duration_s, 0.0, 3600.0);
  check("start_m", c.start_m, -1e3, 1e3);
  check("y_m", c.y_m, -1e3, 1e3);
  const double count = std::round(c.duration_s * c.rate_Hz);
  if (count > kMostSamples) throw Error("stroke: " + number_text(count) + " samples, more than 2^28");
  return static_cast<std::size_t>(count);
}

void stroke_heights(const TextureModel& model, const StrokeConfig& c, std::vector<double>& x,
                    const Observer& observer) {
  RowWatch watch(observer);
  const double step_m = c.speed_mps / c.rate_Hz;
  const auto slope = [&](double samples) {
    return evaluate_height(model, c.start_m + samples * step_m, c.y_m).slope_x;
  };
  double last = slope(-0.5);
  for (std::size_t i = 0; i < x.size(); ++i) {
    watch.next();
    const double next = slope(static_cast<double>(i) + 0.5);
    x[i] = c.speed_mps * c.rate_Hz * (next - last);
    last = next;
  }
}

}  // namespace

std::vector<double> synthesize_stroke(const Texture& texture, const StrokeConfig& config, const Observer& observer) {
  std::vector<double> x(samples_of(config));
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (SeriesModel<Model>)
          TextureModelTraits<Model>::stroke(model, config, x, observer);
        else
          stroke_heights(texture.model, config, x, observer);
      },
      texture.model);
  return x;
}

}  // namespace asperity

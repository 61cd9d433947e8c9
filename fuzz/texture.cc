// A texture file is refused with an Error, or reads, evaluates to numbers and writes itself back. What follows
// the first byte 0 of the input is the image or table that the file names.
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "asperity/base/error.h"
#include "asperity/texture/evaluate_autoregressive.h"
#include "asperity/texture/evaluate_decaying_sinusoids.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/evaluate_stochastic.h"
#include "asperity/texture/texture_file.h"
#include "fuzz_input.h"

namespace {

bool evaluates(const asperity::TextureModel& model) {
  if (asperity::is_height_field(model)) return std::isfinite(asperity::evaluate_height(model, 0.0123, 0.004).height_m);
  return std::visit(
      [](const auto& series) {
        if constexpr (requires(asperity::SeriesState & s) { next_force(series, s, 0.0, 0.0, 0.0); }) {
          asperity::SeriesState state = asperity::start_series(1);
          for (int i = 0; i < 20; ++i) {
            const auto force = next_force(series, state, 0.01 * i, 0.1 * i, 1e-3);
            if (!std::isfinite(force.normal_N) || !std::isfinite(force.tangential_N)) return false;
          }
        }
        return true;
      },
      model);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input = asperity::fuzz_text(data, size);
  const auto end = input.find('\0');
  const std::string payload(end == std::string_view::npos ? std::string_view() : input.substr(end + 1));
  asperity::Texture texture;
  try {
    texture = asperity::parse_texture(input.substr(0, end), "fuzz", [&](const std::string&) { return payload; });
  } catch (const asperity::Error&) {
    return 0;
  }
  asperity::must(evaluates(texture.model));
  const auto written = asperity::format_texture_files(texture, "again");
  const auto again = asperity::parse_texture(written.json, "again",
                                             [&](const std::string&) { return written.payloads.at(0).content; });
  const auto twice = asperity::format_texture_files(again, "again");
  asperity::must(twice.json == written.json);
  asperity::must(twice.payloads.size() == written.payloads.size());
  for (std::size_t i = 0; i < twice.payloads.size(); ++i)
    asperity::must(twice.payloads[i].content == written.payloads[i].content);
  return 0;
}

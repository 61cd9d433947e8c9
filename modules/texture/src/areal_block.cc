#include <cmath>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "block_json.h"
#include "model_block.h"

namespace asperity {
namespace {

constexpr std::int64_t kMostASide = 4096;
constexpr std::size_t kMostNodes = 1 << 22;
constexpr const char* kHeader = "x_m,y_m,coefficient_m,supported";

double node_x_m(const SplineGrid& g, std::size_t column) {
  return g.origin_x_m + static_cast<double>(column) * g.spacing_x_m;
}

double node_y_m(const SplineGrid& g, std::size_t row) {
  return g.origin_y_m + static_cast<double>(row) * g.spacing_y_m;
}

std::string surface_csv(const ArealTexture& t) {
  const SplineGrid& g = t.surface;
  std::string out = kHeader;
  out += t.sigma_m.empty() ? "\n" : ",sigma_m\n";
  for (std::size_t i = 0; i < g.coefficient_m.size(); ++i) {
    append_number(out, node_x_m(g, i % g.columns));
    out += ',';
    append_number(out, node_y_m(g, i / g.columns));
    if (!std::isfinite(g.coefficient_m[i]))
      throw Error("texture: 'coefficient_m' is " + number_text(g.coefficient_m[i]) + ", which a file cannot hold");
    out += ',' + number_text(g.coefficient_m[i]) + (t.supported[i] ? ",1" : ",0");
    if (!t.sigma_m.empty()) {
      if (!(t.sigma_m[i] >= 0.0) || !std::isfinite(t.sigma_m[i]))
        throw Error("texture: 'sigma_m' is " + number_text(t.sigma_m[i]) + ", which is not a standard deviation");
      out += ',' + number_text(t.sigma_m[i]);
    }
    out += '\n';
  }
  return out;
}

void parse_surface(const std::string& text, const std::string& name, ArealTexture& t) {
  SplineGrid& g = t.surface;
  const std::size_t count = g.columns * g.rows;
  CsvReader csv(text, name);
  const std::size_t x = csv.require("x_m");
  const std::size_t y = csv.require("y_m");
  const std::size_t coefficient = csv.require("coefficient_m");
  const std::size_t supported = csv.require("supported");
  const auto sigma = csv.find("sigma_m");
  if (csv.columns().size() != (sigma ? 5u : 4u))
    throw Error(name + ":1: more columns than " + kHeader + " and sigma_m");
  g.coefficient_m.reserve(count);
  t.supported.reserve(count);
  while (csv.next()) {
    const std::size_t i = g.coefficient_m.size();
    if (i == count) csv.fail(coefficient, "more rows than the block's " + std::to_string(count));
    if (!(std::abs(csv.number(x) - node_x_m(g, i % g.columns)) <= 1e-3 * g.spacing_x_m))
      csv.fail(x, "is not this grid point's " + number_text(node_x_m(g, i % g.columns)));
    if (!(std::abs(csv.number(y) - node_y_m(g, i / g.columns)) <= 1e-3 * g.spacing_y_m))
      csv.fail(y, "is not this grid point's " + number_text(node_y_m(g, i / g.columns)));
    const double value = csv.number(coefficient);
    if (!(std::abs(value) <= kLargestHeight_m)) csv.fail(coefficient, number_text(value) + " is not a height");
    const std::int64_t flag = csv.integer(supported);
    if (flag != 0 && flag != 1) csv.fail(supported, "is neither 0 nor 1");
    g.coefficient_m.push_back(value);
    t.supported.push_back(static_cast<std::uint8_t>(flag));
    if (!sigma) continue;
    const double sigma_m = csv.number(*sigma);
    if (!(sigma_m >= 0.0 && sigma_m <= kLargestHeight_m))
      csv.fail(*sigma, number_text(sigma_m) + " is not a standard deviation");
    t.sigma_m.push_back(sigma_m);
  }
  if (g.coefficient_m.size() != count || csv.truncated()) {
    throw Error(name + ":" + std::to_string(csv.line()) + ": " + std::to_string(g.coefficient_m.size()) +
                " whole rows where the block states " + std::to_string(count));
  }
}

}  // namespace

void TextureModelTraits<ArealTexture>::read_block(const BlockInput& input, ArealTexture& t) {
  JsonObject& block = input.block;
  SplineGrid& g = t.surface;
  g.columns = static_cast<std::size_t>(block.required("columns").integer(4, kMostASide));
  g.rows = static_cast<std::size_t>(block.required("rows").integer(4, kMostASide));
  if (g.columns * g.rows > kMostNodes) block.fail("rows", "more than " + std::to_string(kMostNodes) + " grid points");
  const auto spacing_m = block.required("spacing_m").numbers(2, {-1e3, 1e3});
  if (spacing_m.size() != 2 || !(spacing_m[0] >= 1e-12) || !(spacing_m[1] >= 1e-12))
    block.fail("spacing_m", "is not [x, y] of at least 1e-12 m");
  const auto origin_m = block.required("origin_m").numbers(2, {-1e6, 1e6});
  if (origin_m.size() != 2) block.fail("origin_m", "is not [x, y]");
  g.spacing_x_m = spacing_m[0];
  g.spacing_y_m = spacing_m[1];
  g.origin_x_m = origin_m[0];
  g.origin_y_m = origin_m[1];
  g.border = static_cast<Border>(block.required("border").choice(kBorderNames));
  const std::string file = block.required("file").text();
  block.finish();
  parse_surface(input.read_payload(".csv"), file, t);
}

std::string TextureModelTraits<ArealTexture>::write_block(const ArealTexture& t, BlockOutput& output) {
  const SplineGrid& g = t.surface;
  if (g.coefficient_m.size() != g.columns * g.rows || t.supported.size() != g.coefficient_m.size() ||
      (!t.sigma_m.empty() && t.sigma_m.size() != g.coefficient_m.size()))
    throw Error("texture: an areal grid of " + std::to_string(g.columns) + " x " + std::to_string(g.rows) + " with " +
                std::to_string(g.coefficient_m.size()) + " coefficients");
  const std::string file = output.add_payload(".surface.csv", surface_csv(t));
  JsonWriter block = block_writer();
  block.text("file", file);
  block.integer("columns", static_cast<std::int64_t>(g.columns));
  block.integer("rows", static_cast<std::int64_t>(g.rows));
  block.numbers("spacing_m", {g.spacing_x_m, g.spacing_y_m});
  block.numbers("origin_m", {g.origin_x_m, g.origin_y_m});
  block.text("border", kBorderNames.at(static_cast<std::size_t>(g.border)));
  return block.take();
}

}  // namespace asperity

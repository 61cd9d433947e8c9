#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/random.h"
#include "asperity/testkit/temp_dir.h"
#include "asperity/texture/evaluate_height.h"
#include "asperity/texture/fit_areal.h"
#include "asperity/texture/fit_fourier2d.h"
#include "asperity/texture/make_height_map.h"
#include "asperity/texture/texture_file.h"

namespace asperity {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

Fourier1d profile() {
  Random random(3);
  Fourier1d f{10.0, {}, {}, 1e-6};
  for (int j = 1; j <= 16; ++j) {
    f.a_m.push_back(1e-5 * random.normal() / j);
    f.b_m.push_back(1e-5 * random.normal() / j);
  }
  return f;
}

Texture surface(Fourier2dKind kind) {
  FitFourier2dConfig config;
  config.kind = static_cast<Fourier2dFitKind>(static_cast<int>(kind) + 1);  // after auto
  config.seed = 77;
  Texture t;
  t.name = "surface";
  t.model = fit_fourier2d(profile(), profile(), config).texture;
  return t;
}

Texture map(int bits) {
  MakeHeightMapConfig config;
  config.columns = 20;
  config.rows = 12;
  config.bits = bits;
  Texture t;
  t.name = "map";
  t.model = make_height_map(surface(Fourier2dKind::kPattern).model, config).texture;
  return t;
}

Texture area() {
  std::vector<ArealSample> samples;
  Random random(4);
  for (int i = 0; i < 400; ++i)
    samples.push_back({random.uniform(0.0, 3e-3), random.uniform(0.0, 2e-3), 1e-6 * random.normal()});
  Texture t;
  t.name = "area";
  t.model = fit_areal(samples, {.spacing_mm = 0.3}).texture;
  return t;
}

TEST(FieldFile, EachModelComesBackWithTheSameHeightsAndBytes) {
  const testkit::TempDir dir;
  for (const Texture& t : {surface(Fourier2dKind::kOuter), surface(Fourier2dKind::kPattern),
                           surface(Fourier2dKind::kIsotropic), map(8), map(16), area()}) {
    const auto path = dir.path() / "a.texture.json";
    write_texture(path, t);
    const Texture back = read_texture(path);
    EXPECT_EQ(back.model_name(), t.model_name());
    for (double x = -0.01; x < 0.01; x += 7.7e-4) {
      const HeightAndGradient a = evaluate_height(t.model, x, 0.3 * x);
      const HeightAndGradient b = evaluate_height(back.model, x, 0.3 * x);
      EXPECT_EQ(a.height_m, b.height_m);
      EXPECT_EQ(a.slope_x, b.slope_x);
      EXPECT_EQ(a.slope_y, b.slope_y);
    }
    const TextureFiles first = format_texture_files(t, "a");
    const TextureFiles again = format_texture_files(back, "a");
    EXPECT_EQ(first.json, again.json);
    ASSERT_EQ(first.payloads.size(), again.payloads.size());
    for (std::size_t i = 0; i < first.payloads.size(); ++i) {
      EXPECT_EQ(first.payloads[i].file, again.payloads[i].file);
      EXPECT_EQ(first.payloads[i].content, again.payloads[i].content);
      EXPECT_EQ(read_file(dir.path() / first.payloads[i].file, 1 << 20), first.payloads[i].content);
    }
  }
}

TEST(FieldFile, PayloadsAreCalledAfterTheTexture) {
  EXPECT_EQ(format_texture_files(map(16), "x").payloads.at(0).file, "x.heights.png");
  EXPECT_EQ(format_texture_files(area(), "x").payloads.at(0).file, "x.surface.csv");
  EXPECT_TRUE(format_texture_files(surface(Fourier2dKind::kIsotropic), "x").payloads.empty());
}

void expect_refused(const Texture& texture, const std::string& from, const std::string& to, const std::string& place,
                    const std::string& message) {
  TextureFiles files = format_texture_files(texture, "x");
  const auto at = files.json.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  files.json.replace(at, from.size(), to);
  const auto payload = [&](const std::string&) { return files.payloads.empty() ? "" : files.payloads[0].content; };
  EXPECT_THAT([&] { parse_texture(files.json, "x.json", payload); },
              ThrowsMessage<Error>(AllOf(HasSubstr("x.json:"), HasSubstr(place), HasSubstr(message))))
      << to;
}

TEST(FieldFile, NamesLineAndKeyOfWhatIsWrong) {
  const Texture outer = surface(Fourier2dKind::kOuter);
  const Texture isotropic = surface(Fourier2dKind::kIsotropic);
  expect_refused(outer, "\"outer\"", "\"inner\"", "'fourier2d.kind'",
                 "'inner' is not one of outer, pattern, isotropic");
  expect_refused(outer, "\"length_mm\": 10", "\"length_mm\": 0",
                 "x.json:8:", "key 'fourier2d.x.length_mm': 0 is outside");
  expect_refused(outer, "\"scale_per_m\"", "\"scale\"", "'fourier2d.scale_per_m'", "is missing");
  expect_refused(isotropic, "\"seed\": 77", "\"seed\": 7.5", "'fourier2d.seed'", "must be a whole number");
  expect_refused(isotropic, "\"seed\": 77", "\"seed\": 18446744073709551615", "'fourier2d.seed'", "is outside");
  expect_refused(isotropic, "\"power_m2\": [", "\"power_m2\": [-1, ", "'fourier2d.power_m2[0]'", "is negative");
  expect_refused(map(16), "\"columns\": 20", "\"columns\": 21", "'heightmap.file'", "the block states 21 x 12");
  expect_refused(map(16), "\"columns\": 20", "\"columns\": 1000000000000", "'heightmap.columns'", "is outside");
  expect_refused(map(16), "\"bits\": 16", "\"bits\": 12", "'heightmap.bits'", "neither 8 nor 16");
  expect_refused(map(16), "\"border\": \"periodic\"", "\"border\": \"torn\"", "'heightmap.border'", "'torn'");
  expect_refused(area(), "\"spacing_m\": [", "\"spacing_m\": [0, ", "'areal.spacing_m'", "has 3 entries, more than 2");
}

TEST(FieldFile, KeepsToItsFolder) {
  for (const char* name : {"../x.png", "/etc/x.png", "a/b.png", "..\\\\x.png", ".x.png", "c:x.png", "x.txt", ""}) {
    expect_refused(map(16), "x.heights.png", name, "'heightmap.file'", "is not the plain name");
  }
  const TextureFiles files = format_texture_files(map(16), "x");
  EXPECT_THAT([&] { parse_texture(files.json, "x.json"); },
              ThrowsMessage<Error>(HasSubstr("cannot be read from text")));
  const testkit::TempDir dir;
  std::filesystem::create_directory(dir.path() / "in");
  write_file(dir.path() / "x.heights.png", files.payloads[0].content);
  write_file(dir.path() / "in" / "x.texture.json", files.json);
  EXPECT_THAT([&] { read_texture(dir.path() / "in" / "x.texture.json"); },
              ThrowsMessage<Error>(HasSubstr("no such file")));
  std::filesystem::create_symlink(dir.path() / "x.heights.png", dir.path() / "in" / "x.heights.png");
  EXPECT_THAT([&] { read_texture(dir.path() / "in" / "x.texture.json"); },
              ThrowsMessage<Error>(HasSubstr("symbolic link")));
}

TEST(FieldFile, ReadsASurfaceStrictly) {
  const TextureFiles good = format_texture_files(area(), "x");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string content = good.payloads[0].content;
    content.replace(content.find(from), from.size(), to);
    return [&, content] { parse_texture(good.json, "x.json", [&](const std::string&) { return content; }); };
  };
  const std::string& content = good.payloads[0].content;
  const std::string last = content.substr(content.rfind('\n', content.size() - 2) + 1);
  EXPECT_THAT(with(last, ""), ThrowsMessage<Error>(HasSubstr("whole rows where the block states")));
  EXPECT_THAT(with(last, last + last), ThrowsMessage<Error>(HasSubstr("more rows than the block's")));
  EXPECT_THAT(with("coefficient_m", "height_m"), ThrowsMessage<Error>(HasSubstr("'coefficient_m' is missing")));
  EXPECT_THAT(with(last, "1,2,3,4\n"), ThrowsMessage<Error>(HasSubstr("is not this grid point's")));
  EXPECT_THAT(with(last, last.substr(0, last.size() - 2) + "2\n"), ThrowsMessage<Error>(HasSubstr("neither 0 nor 1")));
}

// An area's standard deviations are a column that other surfaces do not have.
TEST(FieldFile, KeepsTheStandardDeviationsOfAnArea) {
  Texture with = area();
  auto& areal = std::get<ArealTexture>(with.model);
  for (std::size_t i = 0; i < areal.supported.size(); ++i) areal.sigma_m.push_back(1e-6 * static_cast<double>(i % 7));
  const TextureFiles files = format_texture_files(with, "x");
  const auto read = [&](const std::string& content) {
    return parse_texture(files.json, "x.json", [&](const std::string&) { return content; });
  };
  const Texture again = read(files.payloads[0].content);
  EXPECT_EQ(std::get<ArealTexture>(again.model).sigma_m, areal.sigma_m);
  EXPECT_EQ(std::get<ArealTexture>(again.model).supported, areal.supported);
  EXPECT_EQ(format_texture_files(again, "x").payloads[0].content, files.payloads[0].content);
  EXPECT_EQ(format_texture_files(area(), "x").payloads[0].content.find("sigma_m"), std::string::npos);
  std::string bad = files.payloads[0].content;
  bad.replace(bad.find(",1e-06\n"), 7, ",-1e-06\n");
  EXPECT_THAT([&] { read(bad); }, ThrowsMessage<Error>(HasSubstr("is not a standard deviation")));
  areal.sigma_m.pop_back();
  EXPECT_THROW(format_texture_files(with, "x"), Error);
}

TEST(EvaluateHeight, KnowsPeriodAndOffset) {
  EXPECT_DOUBLE_EQ(period_m(surface(Fourier2dKind::kIsotropic).model).value(), 0.01);
  EXPECT_FALSE(period_m(area().model).has_value());
  for (const Texture& t : {surface(Fourier2dKind::kOuter), surface(Fourier2dKind::kIsotropic), map(16), area()}) {
    const double offset_m = height_offset_m(t.model);
    double lowest = 1.0;
    for (double x = -0.01; x < 0.02; x += 1.3e-4) {
      for (double y = -0.01; y < 0.02; y += 1.3e-4)
        lowest = std::min(lowest, evaluate_height(t.model, x, y).height_m + offset_m);
    }
    // A pattern search ends a thousandth of a cell from the lowest point.
    EXPECT_GE(lowest, -1e-10) << t.model_name();
    EXPECT_LE(lowest, 1e-6) << t.model_name();
  }
  const TextureModel noise = StochasticTexture{};
  EXPECT_FALSE(is_height_field(noise));
  EXPECT_TRUE(std::isnan(evaluate_height(noise, 0.0, 0.0).height_m));
  EXPECT_THAT([&] { static_cast<void>(height_offset_m(noise)); },
              ThrowsMessage<Error>(HasSubstr("stochastic has no heights")));
}

}  // namespace
}  // namespace asperity

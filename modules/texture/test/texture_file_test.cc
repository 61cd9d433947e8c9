#include "asperity/texture/texture_file.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "asperity/base/error.h"
#include "asperity/testkit/temp_dir.h"

namespace asperity {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

Texture whole_texture() {
  Texture t;
  t.name = "sand \"paper\" µ";
  t.model = Fourier1d{10.0, {1.0 / 3.0, -2e-6, 0.0}, {5e-324, 4e-6, 1e-6}, 1e-7};
  t.compliance_kc = 0.9556;
  t.stiffness_N_per_m = 1200.0;
  t.friction = 0.3;
  t.height_offset_m = 1.25e-4;
  t.roughness = {{"Ra_m", 1e-5}, {"Rsk", -0.2}};
  t.band_cycles_per_mm = {0.1, 4.0};
  t.height_sigma_m = 2.5e-6;
  t.source = {"scan one", Json{{"coefficients", 128}}, "0.1.0", 40.5};
  t.extra = {{"note", {1, 2}}};
  return t;
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = format_texture(whole_texture());
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_error(const std::string& text, const std::string& place, const std::string& message) {
  EXPECT_THAT([&] { parse_texture(text, "x.json"); }, ThrowsMessage<Error>(AllOf(HasSubstr(place), HasSubstr(message))))
      << text.substr(0, 300);
}

TEST(TextureFile, ComesBackAsItWas) {
  const testkit::TempDir dir;
  const auto path = dir.path() / "a.texture.json";
  const Texture t = whole_texture();
  write_texture(path, t);
  const Texture back = read_texture(path);
  EXPECT_EQ(back.name, t.name);
  const auto& series = std::get<Fourier1d>(t.model);
  const auto& series_back = std::get<Fourier1d>(back.model);
  EXPECT_EQ(series_back.length_mm, 10.0);
  EXPECT_EQ(series_back.a_m, series.a_m);
  EXPECT_EQ(series_back.b_m, series.b_m);
  EXPECT_EQ(series_back.mean_m, series.mean_m);
  EXPECT_EQ(back.compliance_kc, t.compliance_kc);
  EXPECT_EQ(back.stiffness_N_per_m, t.stiffness_N_per_m);
  EXPECT_EQ(back.friction, t.friction);
  EXPECT_EQ(back.height_offset_m, t.height_offset_m);
  EXPECT_EQ(back.height_sigma_m, t.height_sigma_m);
  EXPECT_EQ(back.source.snr, t.source.snr);
  EXPECT_EQ(back.roughness, t.roughness);
  EXPECT_EQ(back.band_cycles_per_mm, t.band_cycles_per_mm);
  EXPECT_EQ(back.source.recording, t.source.recording);
  EXPECT_EQ(back.source.config, t.source.config);
  EXPECT_EQ(back.source.version, t.source.version);
  EXPECT_EQ(back.extra, t.extra);
  EXPECT_EQ(format_texture(back), format_texture(t));
}

TEST(TextureFile, KnowsHowMuchMoreStickingBears) {
  Texture t = whole_texture();
  EXPECT_FALSE(parse_texture(format_texture(t), "x.json").static_friction_ratio.has_value());
  t.static_friction_ratio = 1.4;
  EXPECT_EQ(parse_texture(format_texture(t), "x.json").static_friction_ratio, 1.4);
  t.static_friction_ratio = 0.9;
  expect_error(format_texture(t), "'static_friction_ratio'", "0.9 is outside 1 to 100");
}

// The fit's report is ours; the members around it are not, and all are kept as they were.
TEST(TextureFile, FitStaysWhereItStands) {
  for (const char* extra : {R"({"fit":{"samples":7,"rms_error_m":1e-06},"note":[1,2]})", R"({"note":[1,2],"fit":null})",
                            R"({"a":1,"fit":{},"b":2.0})"}) {
    const std::string text = with(R"({"note":[1,2]})", extra);
    const Texture back = parse_texture(text, "x.json");
    EXPECT_TRUE(back.fit) << extra;
    EXPECT_FALSE(back.extra.contains("fit")) << extra;
    EXPECT_EQ(format_texture(back), text);
  }
  EXPECT_FALSE(parse_texture(format_texture(whole_texture()), "x.json").fit);
}

TEST(TextureFile, ReadsTheContractsExample) {
  const Texture t = parse_texture(R"({"format":"asperity-texture","version":1,"name":"x","model":"fourier1d",
 "fourier1d":{"length_mm":10,"omega_rad_per_mm":0.6283,"a_m":[1e-6],"b_m":[0],"mean_m":0},
 "roughness":{"Ra_m":1e-6},"band_cycles_per_mm":[0.15,4],"source":{"recording":"r","config":{},"version":"1"},"extra":{}})",
                                  "x.json");
  EXPECT_EQ(std::get<Fourier1d>(t.model).a_m.at(0), 1e-6);
  EXPECT_FALSE(t.friction.has_value());
}

TEST(TextureFile, NamesFileLineAndKeyOfWhatIsWrong) {
  expect_error("", "x.json:1:", "not JSON");
  expect_error("{\n\"format\": 1,\n,}", "x.json:3:", "not JSON");
  expect_error("[]", "x.json:1:", "must be a JSON object");
  expect_error("{}", "x.json:1:", "key 'format': is missing");
  expect_error(with("asperity-texture", "asperity-scene"), "x.json:2:", "key 'format': must be \"asperity-texture\"");
  expect_error(with("\"version\": 1", "\"version\": 2"),
               "x.json:3:", "key 'version': must be 1, the version that this program reads; found 2");
  expect_error(with("\"model\": \"fourier1d\"", "\"model\": \"wavelet\""),
               "x.json:5:", "key 'model': 'wavelet' is not a model");
  expect_error(with("\"friction\"", "\"fricton\""), "'fricton'", "is not known here");
  expect_error(with("\"mean_m\"", "\"man_m\""), "x.json:11:", "key 'fourier1d.man_m': is not known here");
  expect_error(with("\"length_mm\": 10", "\"length_mm\": \"10\""),
               "x.json:7:", "key 'fourier1d.length_mm': must be a number, found \"10\"");
  expect_error(with("\"length_mm\": 10", "\"length_mm\": -10"), "'fourier1d.length_mm'", "-10 is outside");
  expect_error(with("\"length_mm\": 10", "\"length_mm\": 20"), "'fourier1d.omega_rad_per_mm'", "is not 2π / length_mm");
  expect_error(with("-2e-06", "null"), "x.json:9:", "key 'fourier1d.a_m[1]': must be a number, found null");
  expect_error(with("-2e-06", "1e999"), "x.json:9:", "number overflow");
  expect_error(with("-2e-06, ", ""), "x.json:10:", "key 'fourier1d.b_m': 3 numbers where a_m has 2");
  expect_error(with("0.9556", "1.5"), "x.json:13:", "key 'compliance_kc': 1.5 is outside 0 to 1");
  expect_error(with("[0.1, 4]", "[4, 0.1]"), "'band_cycles_per_mm'", "is not [low, high]");
  expect_error(with("[0.1, 4]", "[0.1, 1e308]"), "'band_cycles_per_mm'", "is not [low, high]");
  expect_error(with("\"lift_m\": ", "\"friction\": 1, \"lift_m\": "), "x.json:16:", "key 'friction' appears twice");
  expect_error(with("{\"note\":[1,2]}", "7"), "'extra'", "must be an object");
  expect_error(with("[1,2]", std::string(1000, '[') + std::string(1000, ']')),
               "x.json:21:", "nested more than 32 deep");
}

TEST(TextureFile, LongReadIsStopped) {
  Texture t = whole_texture();
  std::get<Fourier1d>(t.model).a_m.resize(10000);
  std::get<Fourier1d>(t.model).b_m.resize(10000);
  Observer observer;
  observer.cancelled = [] { return true; };
  EXPECT_THROW(parse_texture(format_texture(t), "x.json", {}, observer), Cancelled);
}

TEST(TextureFile, RefusesTooManyCoefficients) {
  std::string many = "[0";
  for (int i = 0; i < 65536; ++i) many += ",0";
  expect_error(with("[0.3333333333333333, -2e-06, 0]", many + "]"), "'fourier1d.a_m'",
               "has 65537 entries, more than 65536");
}

TEST(TextureFile, WritesOnlyWhatCanBeRead) {
  Texture t = whole_texture();
  t.height_offset_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { format_texture(t); }, ThrowsMessage<Error>(HasSubstr("lift_m: nan cannot be written")));
  t = whole_texture();
  std::get<Fourier1d>(t.model).b_m.pop_back();
  EXPECT_THAT([&] { format_texture(t); }, ThrowsMessage<Error>(HasSubstr("3 cosine and 2 sine coefficients")));
  t = whole_texture();
  t.extra = Json::array();
  EXPECT_THAT([&] { format_texture(t); }, ThrowsMessage<Error>(HasSubstr("extra is not an object")));
  t = whole_texture();
  t.name = "\xFF";
  EXPECT_THAT([&] { format_texture(t); }, ThrowsMessage<Error>(HasSubstr("not UTF-8")));
}

}  // namespace
}  // namespace asperity

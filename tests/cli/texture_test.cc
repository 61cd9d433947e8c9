#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// 60 mm of a wave of 2.5 mm pitch and `amplitude_um` height, as profile.csv of `process` has them.
std::string wave_profile(double amplitude_um, double pitch_mm = 2.5) {
  std::string text = "s_m,height_m,texture_m\n";
  for (int i = 0; i < 2400; ++i) {
    const std::string z = std::to_string(1e6 * amplitude_um * std::sin(2 * std::numbers::pi * 0.025 * i / pitch_mm));
    text += std::to_string(25 * i) + "e-6," + z + "e-12," + z + "e-12\n";
  }
  return text;
}

class TextureCommands : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (dir_ / name).string(); }

  Json done(std::vector<std::string> words) const {
    words.emplace_back("--json");
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.code == 0 ? Json::parse(outcome.out) : Json();
  }

  std::map<std::string, std::string> files_in(const std::string& folder) const {
    const auto files = contents(path(folder));
    return {files.begin(), files.end()};
  }

  testkit::TempDir dir_;
};

// A map as an instrument's program writes it: header lines in Latin-1, decimal commas, points without a height left
// out.
TEST_F(TextureCommands, AnArealModelOfAnInstrumentsTable) {
  std::string text = "Ger\xe4t Typ 1\nx [mm];y [mm];z [\xb5m]\n";
  for (int i = 0; i < 24 * 20; ++i) {
    const double z = 2 * std::cos(0.5 * (i % 24)) * std::cos(0.4 * (i / 24));
    if (i % 37 != 5) text += fmt::format("{};{};{:.4f}\n", 0.1 * (i % 24), 0.1 * (i / 24), z);
  }
  std::replace(text.begin(), text.end(), '.', ',');
  write_text(path("map.csv"), text);
  const Json fitted = done({"texture", "fit", path("map.csv"), "--model", "areal", "-o", path("x.texture.json")});
  EXPECT_EQ(fitted["model"], "areal") << fitted;
}

TEST_F(TextureCommands, EveryModelOfHeightsIsFittedAndDescribed) {
  write_text(path("p.csv"), wave_profile(20));
  const double rms_m = 20e-6 / std::sqrt(2.0);
  for (const std::string model : {"fourier1d", "fourier2d", "heightmap", "areal", "stochastic"}) {
    std::vector<std::string> words{"texture",
                                   "fit",
                                   path("p.csv"),
                                   "--model",
                                   model,
                                   "-o",
                                   path("x.texture.json"),
                                   "--set",
                                   "fourier2d.kind=pattern"};
    if (model == "areal") {
      // Strokes of one wave, each measured by itself: 5 nm apart.
      for (const int k : {1, 2, 3}) {
        const std::string stroke = path("p" + std::to_string(k) + ".csv");
        write_text(stroke, wave_profile(20 + 5e-3 * k));
        words.insert(words.begin() + 2, stroke);
      }
      words.insert(words.end(), {"--set", "fit.stroke_spacing_mm=1", "--set", "areal.spacing_mm=0.25"});
    }
    const Json fit = done(words);
    EXPECT_EQ(fit["model"], model);
    const Json info = done({"texture", "info", path("x.texture.json")});
    EXPECT_EQ(info["model"], model);
    EXPECT_EQ(info["fit"], fit["fit"]);
    // For a person: labels with units, none of the keys.
    const Outcome shown = run({"texture", "info", path("x.texture.json")});
    const std::string table = shown.out.substr(shown.out.find('\n'));
    EXPECT_EQ(table.find('_'), std::string::npos) << table;
    EXPECT_EQ(table.find('"'), std::string::npos) << table;
    EXPECT_EQ(table.find('['), std::string::npos) << table;
    if (model == "fourier1d") {
      EXPECT_THAT(table, HasSubstr("\n  Length                 10 mm\n"));
      EXPECT_THAT(table, HasSubstr("\n  Height offset          20"));
      EXPECT_THAT(table, HasSubstr("cycles/mm\n"));
    }
    if (model == "fourier1d" || model == "areal") {
      // A grid of ten points a pitch, held smooth and turned back at its borders, loses a little of the wave.
      const double lost = model == "areal" ? 0.03 : 0.01;
      EXPECT_NEAR(info["measured"]["Rq_m"].get<double>(), rms_m, lost * rms_m) << model;
      EXPECT_NEAR(info["measured"]["RSm_m"].get<double>(), 2.5e-3, 1e-5) << model;
      EXPECT_NEAR(info["lift_m"].get<double>(), 20e-6, 0.2e-6) << model;
      EXPECT_LT(fit["fit"]["rms_error_m"].get<double>(), 0.02 * rms_m) << model;
    }
  }
}

// Seed Fig. 38: what repeats along the path is a pattern, without being asked for one.
TEST_F(TextureCommands, APeriodicProfileGivesAPatternedHeightMap) {
  write_text(path("p.csv"), wave_profile(20, 2.3));
  const Json fit = done({"texture", "fit", path("p.csv"), "--model", "heightmap", "-o", path("x.texture.json")});
  EXPECT_EQ(fit["fit"]["kind"], "pattern");
  EXPECT_NEAR(fit["fit"]["pitch_m"].get<double>(), 2.3e-3, 2e-6);
  EXPECT_FALSE(fit["fit"].contains("spectrum_error"));
  // Whole periods, so that the image closes: four of 2.3 mm.
  const Json info = done({"texture", "info", path("x.texture.json")});
  const Json& map = info["describe"];
  EXPECT_NEAR(map["mm_per_px"][0].get<double>() * map["columns"].get<double>(), 9.2, 0.03);
  EXPECT_EQ(done({"texture", "fit", path("p.csv"), "--model", "heightmap", "--set", "fourier2d.kind=isotropic", "-o",
                  path("y.texture.json")})["fit"]["kind"],
            "isotropic");
}

TEST_F(TextureCommands, AnXmlFileNeedsItsModel) {
  write_text(path("m.xml"), "<modelSet/>");
  const auto result = run({"texture", "fit", path("m.xml"), "-o", path("x.texture.json")});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("--model autoregressive"));
}

TEST_F(TextureCommands, SynthesizedHeightsAreTheTextures) {
  write_text(path("p.csv"), wave_profile(20));
  done({"texture", "fit", path("p.csv"), "-o", path("x.texture.json")});
  done({"texture", "synthesize", path("x.texture.json"), "--length", "50mm", "-o", path("line.csv")});
  const Json same = done({"texture", "compare", path("x.texture.json"), path("line.csv")});
  EXPECT_EQ(same["verdict"], "same to the hand");
  const Json tile = done({"texture", "synthesize", path("x.texture.json"), "-o", path("tile.png")});
  EXPECT_EQ(tile["columns"], 256);
  EXPECT_NEAR(tile["high_m"].get<double>() - tile["low_m"].get<double>(), 40e-6, 0.4e-6);
  EXPECT_TRUE(std::filesystem::exists(path("tile.png")));
  EXPECT_EQ(run({"texture", "synthesize", path("x.texture.json"), "--seed", "2", "-o", path("l.csv")}).code, 2);
  EXPECT_EQ(run({"texture", "synthesize", path("x.texture.json"), "-o", path("l.wav")}).code, 2);
}

TEST_F(TextureCommands, ASeedGivesAnotherSurfaceOfTheSameRoughness) {
  std::string text;
  unsigned state = 1;
  double z = 0.0;
  for (int i = 0; i < 4000; ++i) {
    state = 1664525u * state + 1013904223u;
    z = 0.9 * z + static_cast<double>(state >> 8) / 16777216.0 - 0.5;
    text += std::to_string(z) + "\n";
  }
  write_text(path("p.csv"), text);
  done({"texture", "fit", path("p.csv"), "--spacing", "25um", "--model", "fourier2d", "-o", path("x.texture.json")});
  for (const char* seed : {"1", "2"}) {
    done({"texture", "synthesize", path("x.texture.json"), "--seed", seed, "-o", path(std::string(seed) + ".csv")});
  }
  const Json c = done({"texture", "compare", path("1.csv"), path("2.csv")});
  EXPECT_NE(c["roughness"]["Rq_m"]["percent"], 0.0);
  // One line of 40 mm over a surface of 10 mm period.
  EXPECT_NEAR(c["roughness"]["Rq_m"]["percent"].get<double>(), 0.0, 40.0);
}

TEST_F(TextureCommands, CompareHoldsDifferencesAgainstWhatIsFelt) {
  write_text(path("a.csv"), wave_profile(20));
  write_text(path("b.csv"), wave_profile(20.4));
  write_text(path("c.csv"), wave_profile(21));
  const Json same = done({"texture", "compare", path("a.csv"), path("b.csv")});
  EXPECT_EQ(same["noticeable"], false);
  EXPECT_NEAR(same["roughness"]["Rq_m"]["percent"].get<double>(), 2.0, 0.01);
  const Json other = done({"texture", "compare", path("a.csv"), path("c.csv")});
  EXPECT_EQ(other["noticeable"], true);
  EXPECT_EQ(other["roughness"]["Rq_m"]["verdict"], "noticeable");
  EXPECT_EQ(other["roughness"]["Rq_m"]["jnd_percent"], 3.0);
  EXPECT_THAT(run({"texture", "compare", path("a.csv"), path("c.csv")}).out, HasSubstr("at 50 mm/s: noticeable"));
}

TEST_F(TextureCommands, SwappedTexturesKeepTheirSpectrum) {
  write_text(path("a.csv"), wave_profile(20));
  write_text(path("b.csv"), wave_profile(50, 1.25));
  std::filesystem::create_directory(path("scene"));
  done({"texture", "fit", path("a.csv"), "-o", path("scene/a.texture.json")});
  done({"texture", "fit", path("b.csv"), "--model", "heightmap", "--set", "fourier2d.kind=pattern", "-o",
        path("b.texture.json")});
  write_text(path("scene/plane.obj"),
             "v -40 0 40\nv -40 0 -40\nv 40 0 40\nv 40 0 -40\nf 1 3 2\nf 2 3 4\n"
             "h 1 0 0 0 50 50 0\nh 1 50 0 0 50 50 50\n");
  write_text(path("scene/x.scene.json"), R"({"format":"asperity-scene","version":1,"mesh":"plane.obj","unit_m":0.001,)"
                                         R"("textures":[{"index":1,"file":"a.texture.json"}]})");
  const Json swap = done({"texture", "swap", path("scene/x.scene.json"), "1", path("b.texture.json")});
  EXPECT_EQ(swap["before"], "a.texture.json");
  EXPECT_EQ(swap["after"], "b.texture.json");
  const Json c = done({"texture", "compare", path("b.texture.json"), path("scene/b.texture.json")});
  for (const auto& band : c["bands"]) EXPECT_EQ(band["percent"], 0.0);
  EXPECT_EQ(run({"texture", "swap", path("scene/x.scene.json"), "9", path("b.texture.json")}).code, 1);
}

TEST_F(TextureCommands, ASwapReplacesNoOtherFile) {
  write_text(path("a.csv"), wave_profile(20));
  write_text(path("b.csv"), wave_profile(50, 1.25));
  for (const char* folder : {"scene", "new", "other"}) std::filesystem::create_directory(path(folder));
  done({"texture", "fit", path("a.csv"), "-o", path("scene/t.texture.json")});
  done({"texture", "fit", path("b.csv"), "-o", path("new/t.texture.json")});
  // Comments and polygons, which a mesh that we write has not.
  const std::string mesh =
      "# mine\nv -40 0 40\nv -40 0 -40\nv 40 0 40\nv 40 0 -40\nf 1 3 2\nf 2 3 4\n"
      "h 1 0 0 0 50 50 0\nh 1 50 0 0 50 50 50\n";
  write_text(path("scene/plane.obj"), mesh);
  write_text(path("scene/x.scene.json"), R"({"format":"asperity-scene","version":1,"mesh":"plane.obj","unit_m":0.001,)"
                                         R"("textures":[{"index":1,"file":"t.texture.json"}]})");
  const auto before = files_in("scene");
  const Json swap = done({"texture", "swap", path("scene/x.scene.json"), "1", path("new/t.texture.json")});
  EXPECT_EQ(swap["after"], "t-2.texture.json");
  const auto after = files_in("scene");
  EXPECT_EQ(after.at("plane.obj"), mesh);
  EXPECT_EQ(after.at("t.texture.json"), before.at("t.texture.json"));
  // Again: the same texture lies there already.
  EXPECT_EQ(done({"texture", "swap", path("scene/x.scene.json"), "1", path("new/t.texture.json")})["after"],
            "t-2.texture.json");

  write_text(path("other/plane.obj"), "another");
  const Outcome refused = run({"texture", "swap", path("scene/x.scene.json"), "1", path("new/t.texture.json"), "-o",
                               path("other/y.scene.json")});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("plane.obj: exists with other content"));
  EXPECT_EQ(files_in("other"), (std::map<std::string, std::string>{{"plane.obj", "another"}}));
  EXPECT_EQ(run({"texture", "swap", path("scene/x.scene.json"), "1", path("new/t.texture.json"), "-o",
                 path("fresh/y.scene.json")})
                .code,
            0);
  EXPECT_EQ(files_in("fresh").size(), 3u);
}

TEST_F(TextureCommands, APaintedTextureIsCalledAsNoOtherFile) {
  write_text(path("a.csv"), wave_profile(20));
  write_text(path("plane.obj"), "v -40 0 40\nv -40 0 -40\nv 40 0 40\nv 40 0 -40\nf 1 3 2\nf 2 3 4\n");
  done({"texture", "fit", path("a.csv"), "-o", path("paint.json")});
  const std::vector<std::string> words{"paint",     "--mesh-unit",     "mm", "--through=-20,0,0;20,0,0",
                                       "--texture", path("paint.json")};
  const auto onto = [&](const std::string& mesh, const std::string& out) {
    auto all = words;
    all.insert(all.begin() + 1, path(mesh));
    all.insert(all.end(), {"-o", path(out)});
    return done(all);
  };
  EXPECT_EQ(onto("plane.obj", "one")["texture"]["file"], "1-paint.json");
  EXPECT_EQ(onto("one/scene.json", "two")["texture"]["file"], "2-paint.json");
  const Json files = Json::parse(files_in("two").at("files.json"))["files"];
  // What the second covers of the first is kept.
  EXPECT_EQ(files, Json({"1-paint.json", "2-paint.json", "covered.csv", "paint.json", "scene.json", "textured.obj"}));
}

TEST_F(TextureCommands, WrongCommandLinesSayWhy) {
  write_text(path("p.csv"), wave_profile(20));
  EXPECT_EQ(run({"texture"}).code, 2);
  EXPECT_EQ(run({"texture", "fit"}).code, 2);
  const Outcome model = run({"texture", "fit", path("p.csv"), "--model", "wavelet", "-o", path("x.texture.json")});
  EXPECT_EQ(model.code, 2);
  EXPECT_THAT(model.err, HasSubstr("'wavelet' is not one of fourier1d"));
  EXPECT_THAT(model.err, HasSubstr("asperity texture fit --help"));
  EXPECT_EQ(run({"texture", "fit", path("p.csv"), "-o", path("x.csv")}).code, 2);
  EXPECT_EQ(run({"texture", "info", path("p.csv")}).code, 1);
}

}  // namespace
}  // namespace asperity::cli

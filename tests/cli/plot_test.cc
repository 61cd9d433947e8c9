#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Plot : public testing::Test {
 protected:
  // A result made by hand: a wave, and a spectrum with its noise.
  void write_result(const std::string& name, bool valid) const {
    fs::create_directories(dir_ / name);
    std::ostringstream profile, spectrum, path;
    profile << "s_m,height_m,sigma_m,texture_m,force_N,speed_mps,texture_sigma_m\n";
    path << "t_ns,px_m,py_m,pz_m\n";
    for (int i = 0; i < 400; ++i) {
      const double s = 25e-6 * i;
      profile << s << ',' << (i == 100 ? "nan" : "1e-5") << ",2e-6,1e-5,0.5,0.02,1e-6\n";
      path << 1'000'000 * (i + 1) << ',' << s << ",0.01,0.3\n";
    }
    spectrum << "cycles_per_mm,density_m2_mm,low_m2_mm,high_m2_mm,noise_m2_mm\n";
    for (int i = 0; i < 64; ++i) spectrum << 0.04 * i << ",1e-12,0,2e-12,1e-13\n";
    write_text(dir_ / name / "profile.csv", profile.str());
    write_text(dir_ / name / "spectrum.csv", spectrum.str());
    write_text(dir_ / name / "trajectory.csv", path.str());
    write_text(dir_ / name / "result.json",
               std::string(R"({"format": "asperity-result", "version": 1, "recording": "x", "trustworthy": )") +
                   (valid ? "true" : "false") + R"(, "verdict": ")" + (valid ? "" : "nothing was touched") + "\"}");
  }

  std::string at(const std::string& name) const { return (dir_ / name).string(); }

  const testkit::TempDir dir_;
};

TEST_F(Plot, DrawsAResultInEveryFormatTheSameEachTime) {
  write_result("one", true);
  for (const char* ending : {"svg", "png", "pdf"}) {
    const std::string file = at(std::string("a.") + ending);
    const Outcome ran = cli::run({"plot", at("one"), "-o", file});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("profile, texture, spectrum, path"));
    EXPECT_THAT(ran.out, Not(HasSubstr("not drawn")));  // nobody asked for the windows of a compliance
    const std::string first = content(file);
    ASSERT_GT(first.size(), 1000U);
    EXPECT_EQ(cli::run({"plot", at("one"), "-o", file}).code, 0);  // its own file is replaced
    EXPECT_EQ(content(file), first);
  }
  const std::string svg = content(at("a.svg"));
  EXPECT_THAT(svg, HasSubstr("noise floor"));
  EXPECT_THAT(svg, HasSubstr("± σ"));
  EXPECT_THAT(svg, Not(HasSubstr("INVALID")));
}

TEST_F(Plot, NamesThePanelsThatWereAskedForAndAreMissing) {
  write_result("one", true);
  const std::string file = at("a.svg");
  const Outcome asked = cli::run({"plot", at("one"), "-o", file, "--parts", "profile,compliance", "--json"});
  EXPECT_EQ(asked.code, 0) << asked.err;
  EXPECT_THAT(asked.out, HasSubstr("no windows of the compliance"));
  const Outcome all = cli::run({"plot", at("one"), "-o", file, "--json"});
  EXPECT_THAT(all.out, HasSubstr("\"missing\": []"));
  const Outcome none = cli::run({"plot", at("one"), "-o", file, "--parts", "map"});
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.err, HasSubstr("nothing to draw: no areal map"));
}

TEST_F(Plot, SaysInThePictureThatAResultIsInvalid) {
  write_result("one", true);
  write_result("two", false);
  const Outcome ran = cli::run({"plot", at("one"), at("two"), "-o", at("a.svg"), "--parts", "profile"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(content(at("a.svg")), HasSubstr("INVALID: two: nothing was touched"));
}

TEST_F(Plot, DrawsMapsAndProfilesOfOthers) {
  std::ostringstream map, line;
  map << "x_mm,y_mm,z_um\n";
  for (int r = 0; r < 8; ++r)
    for (int c = 0; c < 12; ++c) map << 0.01 * c << ',' << 0.01 * r << ',' << r * c << '\n';
  for (int i = 0; i < 100; ++i) line << i % 7 << '\n';
  write_text(dir_ / "map.csv", map.str());
  write_text(dir_ / "line.txt", line.str());
  Outcome ran = cli::run({"plot", at("map.csv"), "-o", at("map.svg")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(content(at("map.svg")), HasSubstr("data:image/png;base64,"));
  ran = cli::run({"plot", at("line.txt"), "--spacing", "0.5um", "-o", at("line.svg")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("profile, spectrum"));
}

TEST_F(Plot, RefusesWhatItCannotDrawOrWouldLose) {
  write_result("one", true);
  EXPECT_EQ(cli::run({"plot", at("one"), "-o", at("a.gif")}).code, 2);
  EXPECT_EQ(cli::run({"plot", at("one"), "-o", at("a.svg"), "--parts", "heights"}).code, 2);
  Outcome ran = cli::run({"plot", at("none"), "-o", at("a.svg")});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("none: no such file or folder"));
  ran = cli::run({"plot", at("one"), "-o", at("a.svg"), "--parts", "map"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("nothing to draw: no areal map"));
  write_text(dir_ / "mine.svg", "<svg/>");
  EXPECT_EQ(cli::run({"plot", at("one"), "-o", at("mine.svg")}).code, 1);
  EXPECT_EQ(content(at("mine.svg")), "<svg/>");
  write_text(dir_ / "one" / "profile.csv", "s_m,height_m\n0,1e-6\n1e-5,high\n");
  ran = cli::run({"plot", at("one"), "-o", at("b.svg")});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.err, HasSubstr("profile.csv"));
  EXPECT_FALSE(fs::exists(at("b.svg")));
}

}  // namespace
}  // namespace asperity::cli

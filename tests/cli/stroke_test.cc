#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "asperity/testkit/made_stroke.h"
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using testkit::MadeStroke;
using Words = std::vector<std::string>;

// Somebody's haptic recording: acceleration in g and force in gf at 2 kHz, positions in mm at 100 Hz, a file each.
class ImportStroke : public testing::Test {
 protected:
  Words words(const MadeStroke& made, const std::string& output, const Words& more = {}) {
    write_text(dir_ / "a.csv", made.acceleration_table(2000.0, 9.80665, true, true));
    write_text(dir_ / "p.csv", made.position_table(100.0));
    write_text(dir_ / "f.csv", made.force_table(2000.0, 9.80665e-3));
    Words out{"import",    "--stroke",
              "--imu",     file("a.csv"),
              "--pose",    file("p.csv"),
              "--force",   file("f.csv"),
              "--columns", "t=t[s], ax=ax[g], ay=ay[g], az=az[g], px=x[mm], py=y[mm], f=f[gf]",
              "-o",        file(output)};
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }
  std::string file(const std::string& name) const { return (dir_ / name).string(); }

  testkit::TempDir dir_;
};

TEST_F(ImportStroke, BecomesATextureSpectraAndAComparison) {
  MadeStroke made;
  made.length_s = 10.0;
  const Outcome imported = run(words(made, "stroke"));
  EXPECT_EQ(imported.code, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("not determined: heights along a line (Ra, Rz): no orientations"));
  for (const char* name : {"stroke.csv", "stroke.json", "vibration.csv", "spectrum.csv", "files.json"})
    EXPECT_TRUE(std::filesystem::exists(dir_ / "stroke" / name)) << name;
  const auto first = contents(dir_ / "stroke");
  EXPECT_EQ(run(words(made, "stroke")).code, 0);  // replaced by itself, byte for byte
  EXPECT_EQ(contents(dir_ / "stroke"), first);

  const Outcome roughness = run({"roughness", file("stroke"), "--json"});
  EXPECT_EQ(roughness.code, 0) << roughness.err;
  EXPECT_THAT(roughness.out, HasSubstr("\"rms_m\""));
  const std::string texture = file("x.texture.json");
  const Outcome fit = run({"texture", "fit", file("stroke"), "-o", texture});
  EXPECT_EQ(fit.code, 0) << fit.err;
  EXPECT_THAT(fit.out, HasSubstr("autoregressive"));
  EXPECT_EQ(run({"texture", "fit", file("stroke"), "-o", texture, "--model", "fourier1d"}).code, 2);
  EXPECT_THAT(run({"texture", "compare", file("stroke"), file("stroke")}).out, HasSubstr("not determined"));

  made.amplitude_m *= 2.0;
  made.seed = 2;
  EXPECT_EQ(run(words(made, "other")).code, 0);
  const Outcome two = run({"texture", "compare", file("stroke"), file("other")});
  EXPECT_EQ(two.code, 0) << two.err;
  EXPECT_THAT(two.out, HasSubstr("noticeable"));
  EXPECT_THAT(two.out, Not(HasSubstr("inf")));
  EXPECT_THAT(run({"texture", "compare", file("other"), file("stroke")}).out, Not(HasSubstr("inf")));
  const Outcome rendered = run({"texture", "compare", file("other"), texture});
  EXPECT_EQ(rendered.code, 0) << rendered.err;
  EXPECT_THAT(rendered.out, HasSubstr("the speeds of the other's stroke"));
  EXPECT_THAT(rendered.out, HasSubstr("noticeable"));
  EXPECT_EQ(run({"texture", "compare", texture, texture, "--speed", "50mm/s", "--force", "1N"}).code, 0);
}

TEST_F(ImportStroke, EndsWith3WhereNothingWasTouched) {
  MadeStroke air;
  air.force_N = 0.0;
  const Outcome imported = run(words(air, "air"));
  EXPECT_EQ(imported.code, 3);
  EXPECT_THAT(imported.out, HasSubstr("invalid: the force is"));
  const Outcome looked = run(words(air, "unwritten", {"--dry-run"}));
  EXPECT_EQ(looked.code, 3);
  EXPECT_THAT(looked.out, HasSubstr("invalid: the force is"));
  for (const Words& more : {Words{"texture", "fit", file("air"), "-o", file("y.texture.json")},
                            Words{"roughness", file("air")}, Words{"texture", "compare", file("air"), file("air")}}) {
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.code, 1) << more.front();
    EXPECT_THAT(outcome.err, HasSubstr("invalid: the force is"));
  }
  EXPECT_FALSE(std::filesystem::exists(file("y.texture.json")));
}

TEST_F(ImportStroke, OfOneColumnHasNoLengths) {
  MadeStroke made;
  write_text(dir_ / "a.txt", made.acceleration_table(10000.0, 9.80665, false, false));
  const Words words{"import",   "--stroke",   "--imu", file("a.txt"), "--imu-columns",
                    "ax=#1[g]", "--imu-rate", "10000", "-o",          file("stroke")};
  const Outcome imported = run(words);
  EXPECT_EQ(imported.code, 0) << imported.err;
  EXPECT_THAT(imported.out, HasSubstr("not determined: without positions lengths are not known"));
  EXPECT_THAT(imported.out, HasSubstr("limited: force was not measured"));
  const Outcome fit = run({"texture", "fit", file("stroke"), "-o", file("x.texture.json")});
  EXPECT_EQ(fit.code, 1);
  EXPECT_THAT(fit.err, HasSubstr("its speed is not determined"));
  Words stated = words;
  stated.insert(stated.end(), {"--stroke-speed", "50mm/s", "--stroke-force", "1N"});
  EXPECT_EQ(run(stated).code, 0);
  EXPECT_EQ(run({"texture", "fit", file("stroke"), "-o", file("x.texture.json")}).code, 0);
}

TEST_F(ImportStroke, RefusesWhatCannotBe) {
  const MadeStroke made;
  Words wrong = words(made, "stroke");
  wrong[9] = "t=t[s], ax=ax[m/s2], ay=ay[m/s2], az=az[m/s2], px=x[mm], py=y[mm], f=f[gf]";
  const Outcome outcome = run(wrong);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("would be gravity in g"));
  EXPECT_FALSE(std::filesystem::exists(file("stroke")));
  EXPECT_EQ(run({"import", "--stroke", "-o", file("stroke")}).code, 2);
  EXPECT_EQ(run({"import", "-o", file("stroke")}).code, 2);
  EXPECT_EQ(
      run({"import", "--pose", file("p.csv"), "--imu", file("a.csv"), "--imu", file("f.csv"), "-o", file("r")}).code,
      2);
  const Outcome shown = run(words(made, "stroke", {"--dry-run"}));
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_FALSE(std::filesystem::exists(file("stroke")));
}

}  // namespace
}  // namespace asperity::cli

#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

// A sensor at rest for four seconds, as a program with its own names would write it.
class ImportMapped : public testing::Test {
 protected:
  ImportMapped() {
    std::string text = "Time [ms];X [mm];Y [mm];Z [mm];qw;qx;qy;qz;AccX [g];AccY [g];AccZ [g];F [mN]\n";
    for (int i = 0; i < 400; ++i) text += fmt::format("{};1,5;2;{};1;0;0;0;0;0;1;{}\n", 10 * i, i % 3, 100 + i);
    write_text(dir_ / "all.csv", text);
  }

  Words words(const Words& more) const {
    Words out{"import", "--pose", (dir_ / "all.csv").string()};
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }

  testkit::TempDir dir_;
};

TEST_F(ImportMapped, MakesARecordingOfOneTable) {
  const std::string rec = (dir_ / "rec").string(), mapping = (dir_ / "map.toml").string();
  const Outcome shown = run(words({"--dry-run", "--save-mapping", mapping}));
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("#9 AccX"));
  EXPECT_FALSE(std::filesystem::exists(rec));
  EXPECT_EQ(run(words({"-o", rec, "--tip", "0mm,0mm,-120mm"})).code, 0);
  const auto guessed = contents(rec + "/");
  EXPECT_EQ(run({"inspect", rec}).code, 0);
  EXPECT_EQ(run(words({"-o", rec, "--tip", "0mm,0mm,-120mm", "--mapping", mapping})).code, 0);
  for (std::size_t i = 0; i < guessed.size(); ++i) {
    if (guessed[i].first == "recording.json") continue;
    EXPECT_EQ(contents(rec + "/")[i], guessed[i]);
  }
}

TEST_F(ImportMapped, RefusesWhatCannotBe) {
  const std::string rec = (dir_ / "rec").string();
  for (const auto& [columns, message] :
       {std::pair("ax=AccX[mg],ay=AccY[mg],az=AccZ[mg]", "this looks like g; state ax=AccX[g]"),
        std::pair("t=Time[s]", "column 'Time' read in s: the rows come at 0.1 Hz"),
        std::pair("px=X[furlong]", "'furlong' is not a known unit: m, mm"),
        std::pair("px=pos[mm]", "no such column; there are #1 'Time'")}) {
    const Outcome outcome = run(words({"-o", rec, "--columns", columns}));
    EXPECT_EQ(outcome.code, 1) << columns;
    EXPECT_THAT(outcome.err, HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(rec));
  }
  EXPECT_EQ(run(words({"-o", rec, "--columns", "ax=AccX[mg],ay=AccY[mg],az=AccZ[mg]", "--unchecked"})).code, 0);
  EXPECT_EQ(run(words({})).code, 2);  // neither --output nor --dry-run
}

TEST_F(ImportMapped, AMappingDoesNotReplaceData) {
  const std::string data = (dir_ / "all.csv").string(), mapping = (dir_ / "map.toml").string();
  const Outcome over = run(words({"--dry-run", "--save-mapping", data}));
  EXPECT_EQ(over.code, 1);
  EXPECT_THAT(over.err, HasSubstr("all.csv: exists and is not a mapping; nothing was changed"));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(run(words({"--dry-run", "--save-mapping", mapping})).code, 0);
  const Outcome tip = run(words({"--dry-run", "--tip", "0,100,10"}));
  EXPECT_EQ(tip.code, 2);
  EXPECT_THAT(tip.err, HasSubstr("--tip: farther than 10 m; lengths need their unit"));
}

// What was imported cannot be simulated again, nor imported of other data.
TEST_F(ImportMapped, AnImportIsReplacedByTheSameFilesOnly) {
  const std::string rec = (dir_ / "rec").string();
  ASSERT_EQ(run(words({"-o", rec})).code, 0);
  const auto before = contents(rec + "/");
  const Outcome simulated = run({"simulate", "--surface", "sine", "--speed", "50mm/s", "-o", rec});
  EXPECT_EQ(simulated.code, 1);
  EXPECT_THAT(simulated.err,
              HasSubstr("rec: holds a recording that was imported from all.csv, which is replaced only"));
  EXPECT_EQ(contents(rec + "/"), before);
  EXPECT_EQ(run(words({"-o", rec})).code, 0);
  write_text(dir_ / "all.csv",
             "Time [ms];X [mm];Y [mm];Z [mm];qw;qx;qy;qz;AccX [g];AccY [g];AccZ [g];F [mN]\n"
             "0;1;2;0;1;0;0;0;0;0;1;100\n10;1;2;0;1;0;0;0;0;0;1;101\n");
  const Outcome other = run(words({"-o", rec, "--unchecked"}));
  EXPECT_EQ(other.code, 1);
  EXPECT_THAT(other.err, HasSubstr("an import of the same files, unchanged; nothing was changed"));
  EXPECT_EQ(contents(rec + "/"), before);
}

TEST_F(ImportMapped, TheTrackersNoiseCanBeStated) {
  const std::string rec = (dir_ / "rec").string();
  // Rotations that do not change have no noise that could be estimated.
  const Outcome assumed = run(words({"--dry-run"}));
  EXPECT_THAT(assumed.out, HasSubstr("mm (estimated, assumed), rotation 1 mrad (assumed)"));
  const Outcome stated = run(words({"-o", rec, "--tracker-sigma", "0.2mm", "--tracker-sigma-deg", "0.25"}));
  EXPECT_EQ(stated.code, 0) << stated.err;
  EXPECT_THAT(stated.out, HasSubstr("noise       a pose's position 0.2 mm, rotation 4.4 mrad (stated)"));
  const std::vector<std::pair<std::string, std::string>> files = contents(rec + "/");
  std::string calibration;
  for (const auto& [name, text] : files) {
    if (name == "calibration.json") calibration = text;
  }
  EXPECT_THAT(calibration, HasSubstr("[2e-04, 2e-04, 2e-04]"));
  EXPECT_THAT(calibration, HasSubstr("0.00436332"));  // 0.25 π / 180
  EXPECT_THAT(calibration, HasSubstr("tracker_sigma_from"));
  EXPECT_EQ(run(words({"-o", rec, "--tracker-sigma", "0mm"})).code, 2);
  EXPECT_EQ(run(words({"-o", rec, "--tracker-sigma-deg", "x"})).code, 2);
}

TEST_F(ImportMapped, AForceAmongTheSensorsColumnsIsSentToItsOption) {
  const Outcome outcome = run(words({"--dry-run", "--imu-columns", "f='F'[mN]"}));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--force-columns \"f=F[mN]\""));
}

}  // namespace
}  // namespace asperity::cli

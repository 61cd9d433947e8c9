#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/import/measure_stroke_evidence.h"
#include "asperity/import/read_stroke.h"
#include "asperity/import/stroke_file.h"
#include "asperity/import/stroke_spectra.h"
#include "asperity/testkit/made_stroke.h"
#include "asperity/testkit/temp_dir.h"
#include "join_axes.h"

namespace asperity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testkit::MadeStroke;
constexpr double kG = 9.80665, kGf = 9.80665e-3;

std::vector<std::string> codes(const Stroke& stroke) {
  std::vector<std::string> out;
  for (const Verdict& verdict : judge_stroke(measure_stroke_evidence(stroke))) out.push_back(verdict.code);
  return out;
}

class StrokeImport : public testing::Test {
 protected:
  // Acceleration in g and force in gf at 6 kHz, positions in mm at 100 Hz, a file each.
  StrokeReading read(const MadeStroke& made, const std::string& columns = kColumns) {
    write_file(dir_ / "a.csv", made.acceleration_table(6000.0, kG, true, true));
    write_file(dir_ / "p.csv", made.position_table(100.0));
    write_file(dir_ / "f.csv", made.force_table(6000.0, kGf));
    MappingConfig mapping;
    mapping.columns = columns;
    return read_stroke({{dir_ / "a.csv"}, dir_ / "p.csv", dir_ / "f.csv"}, mapping, {});
  }
  // Columns without header and time, a file an axis.
  StrokeReading read_columns(const MadeStroke& made, StrokeImportConfig config, std::size_t axes = 1,
                             const std::string& columns = "ax=#1[g]") {
    StrokeFiles files;
    for (std::size_t i = 0; i < axes; ++i) {
      MadeStroke axis = made;
      axis.seed += static_cast<std::uint32_t>(i);
      files.imu.push_back(dir_ / ("axis" + std::to_string(i) + ".txt"));
      write_file(files.imu.back(), axis.acceleration_table(10000.0, kG, false, false));
    }
    MappingConfig mapping;
    mapping.imu.columns = columns;
    mapping.imu.rate_Hz = 10000.0;
    return read_stroke(files, mapping, config);
  }

  static constexpr const char* kColumns = "t=t[s], ax=ax[g], ay=ay[g], az=az[g], px=x[mm], py=y[mm], f=f[gf]";
  testkit::TempDir dir_;
};

TEST_F(StrokeImport, HasTheHeightsOfKnownWavesFromStreamsOfThreeRates) {
  const MadeStroke made;
  const StrokeReading reading = read(made);
  const Stroke& stroke = reading.stroke;
  EXPECT_THAT(reading.doubts, IsEmpty());
  EXPECT_NEAR(stroke.rate_Hz, 6000.0, 0.01);  // times have microseconds
  EXPECT_EQ(stroke.axes, 3);
  EXPECT_NEAR(stroke.speed_mps[18000], 0.05, 1e-6);
  EXPECT_NEAR(stroke.force_N[18000], 1.0, 0.06);
  EXPECT_THAT(codes(stroke), IsEmpty());  // valid
  // 2 and 5 cycles/mm at 50 mm/s are 100 and 250 Hz. An octave holds the wave's A²/2 but for what the Hann window puts
  // beyond its edge: 2 cycles/mm is such an edge, so the two octaves beside it are taken together.
  const StrokeHeightSpectrum spectrum = stroke_height_spectrum(stroke);
  double low = 0.0, high = 0.0, other = 0.0;
  for (const StrokeHeightBand& band : spectrum.octaves) {
    const double power = band.rms_m * band.rms_m;
    if (band.low_cycles_per_mm == 1.0 || band.low_cycles_per_mm == 2.0) {
      low += power;
    } else if (band.low_cycles_per_mm == 4.0) {
      high = power;
    } else {
      other += power;
    }
  }
  EXPECT_NEAR(std::sqrt(low), made.amplitude_m / std::sqrt(2.0), 0.02 * made.amplitude_m);
  EXPECT_NEAR(std::sqrt(high), 0.25 * made.amplitude_m / std::sqrt(2.0), 0.01 * made.amplitude_m);
  // White noise of 0.05 m/s² has (2π 50 Hz)⁻² · 0.05 · √(50/3000) = 0.07 µm in the octave from 50 Hz; it is taken off.
  EXPECT_LT(std::sqrt(other), 0.1 * made.amplitude_m);
}

TEST_F(StrokeImport, IsNotGreenWithoutASurface) {
  MadeStroke made;
  made.amplitude_m = 0.0;
  EXPECT_THAT(codes(read(made).stroke), ElementsAre("vibration_is_noise"));
  made.seed = 20;
  EXPECT_THAT(codes(read(made).stroke), ElementsAre("vibration_is_noise"));
  MadeStroke air;
  air.force_N = 0.0;
  EXPECT_THAT(codes(read(air).stroke), ElementsAre("nothing_touched"));
  MadeStroke offset;  // reads 1 N in the air, too
  offset.free_N = 1.0;
  EXPECT_THAT(codes(read(offset).stroke), ElementsAre("force_zero_unseen"));
  MadeStroke still;
  still.speed_mps = 1e-3;
  EXPECT_THAT(codes(read(still).stroke), ElementsAre("not_moved"));
  MadeStroke weak;
  weak.amplitude_m = 6e-8;
  EXPECT_THAT(codes(read(weak).stroke), ElementsAre("vibration_weak"));
}

TEST_F(StrokeImport, RefusesUnitsThatCannotBe) {
  const MadeStroke made;
  EXPECT_THAT(read(made, "t=t[s], ax=ax[m/s2], ay=ay[m/s2], az=az[m/s2], px=x[mm], py=y[mm], f=f[gf]").doubts,
              ElementsAre(HasSubstr("would be gravity in g; state ax=…[g]")));
  EXPECT_THAT(read(made, "t=t[s], ax=ax[g], ay=ay[g], az=az[g], px=x[m], py=y[m], f=f[gf]").doubts,
              ElementsAre(HasSubstr("if it is in mm, state px=…[mm]")));
  EXPECT_THAT(read(made, "t=t[s], ax=ax[g], ay=ay[g], az=az[g], px=x[mm], py=y[mm], f=f[N]").doubts,
              ElementsAre(HasSubstr("the force is as large as")));
  EXPECT_THAT(read_columns(made, {}, 1, "").doubts, ElementsAre(HasSubstr("this is a guess")));
}

TEST_F(StrokeImport, StatesWhatColumnsAloneDoNotShow) {
  MadeStroke made;
  made.noise_mps2 = 0.02;
  const Stroke stroke = read_columns(made, {}, 3).stroke;
  EXPECT_EQ(stroke.axes, 3);
  // A second of rest is in it: something shakes the tool, but that it is a surface is not shown.
  EXPECT_THAT(codes(stroke), ElementsAre("contact_unknown", "lengths_undetermined"));
  EXPECT_THAT(stroke_height_spectrum(stroke).octaves, IsEmpty());
  EXPECT_THAT(stroke_unknowns(stroke), testing::Contains(HasSubstr("no positions and no stated speed")));
  made.amplitude_m = 0.0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    made.seed = seed;
    EXPECT_THAT(codes(read_columns(made, {}).stroke), testing::Contains("contact_undetermined"));
  }
  StrokeImportConfig stated;
  stated.speed_mps = 0.05;
  stated.force_N = 1.0;
  stated.noise_mps2 = 0.02;
  EXPECT_THAT(codes(read_columns(made, stated).stroke), testing::Contains("vibration_is_noise"));
}

TEST_F(StrokeImport, RefusesWhatIsNoStroke) {
  const auto fails = [&](const std::string& text, const std::string& message) {
    write_file(dir_ / "a.txt", text);
    MappingConfig mapping;
    mapping.imu.columns = "ax=#1[g]";
    mapping.imu.rate_Hz = 1000.0;
    try {
      read_stroke({{dir_ / "a.txt"}, {}, {}}, mapping, {});
      ADD_FAILURE() << message;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("a.txt"));
      EXPECT_THAT(error.what(), HasSubstr(message));
    }
  };
  std::string constant, brief, words;
  for (int i = 0; i < 2000; ++i) constant += "0.5\n";
  for (int i = 0; i < 100; ++i) brief += i % 2 == 0 ? "0.5\n" : "0.4\n";
  for (int i = 0; i < 1000; ++i) words += i == 700 ? "hello\n" : i % 2 == 0 ? "0.5\n" : "0.4\n";
  fails("", "");
  fails(constant, "never changes");
  fails(brief, "0.5 s at least");
  fails(words, "701");
}

// Rows between two times are left out of a table of times.
std::string without(const std::string& table, double from_s, double to_s) {
  std::string out;
  for (std::size_t at = 0; at < table.size();) {
    const std::size_t end = table.find('\n', at) + 1;
    const std::string line = table.substr(at, end - at);
    const double t = line[0] == 't' ? 0.0 : std::stod(line);
    if (t <= from_s || t >= to_s) out += line;
    at = end;
  }
  return out;
}

TEST_F(StrokeImport, RefusesAGapInAnyStream) {
  const MadeStroke made;
  MappingConfig mapping;
  mapping.columns = kColumns;
  const std::map<std::string, std::string> whole{{"a.csv", made.acceleration_table(2000.0, kG, true, true)},
                                                 {"p.csv", made.position_table(100.0)},
                                                 {"f.csv", made.force_table(2000.0, kGf)}};
  for (const auto& [cut, what] :
       {std::pair("a.csv", "gap of 0.5"), {"p.csv", "the positions"}, {"f.csv", "the force"}}) {
    for (const auto& [name, table] : whole) write_file(dir_ / name, name == cut ? without(table, 2.0, 2.5) : table);
    try {
      read_stroke({{dir_ / "a.csv"}, dir_ / "p.csv", dir_ / "f.csv"}, mapping, {});
      ADD_FAILURE() << cut;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::AllOf(HasSubstr(cut), HasSubstr("a gap of 0.5"), HasSubstr(what)));
    }
  }
}

TEST_F(StrokeImport, ChecksEachAxisOfTheAcceleration) {
  const MadeStroke made;
  const auto axis = [&](double rate_Hz, double unit_mps2) {
    return made.acceleration_table(rate_Hz, unit_mps2, true, false);
  };
  MappingConfig mapping;
  mapping.columns = "t=#1[s], ax=#2[g]";
  const auto read_two = [&](const std::string& second) {
    write_file(dir_ / "x.csv", axis(2000.0, kG));
    write_file(dir_ / "y.csv", second);
    return read_stroke({{dir_ / "x.csv", dir_ / "y.csv"}, {}, {}}, mapping, {});
  };
  const auto refusal = [&](const std::string& second) -> std::string {
    try {
      read_two(second);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(read_two(axis(2000.0, kG)).doubts, IsEmpty());
  EXPECT_THAT(refusal(axis(100.0, kG)), testing::AllOf(HasSubstr("y.csv: 100 samples"), HasSubstr("200 at least")));
  EXPECT_THAT(refusal(axis(400.0, kG)), testing::AllOf(HasSubstr("y.csv"), HasSubstr("have one rate")));
  EXPECT_THAT(refusal(without(axis(2000.0, kG), 2.0, 2.5)), testing::AllOf(HasSubstr("y.csv: a gap of 0.5")));
  // In mg, read as g.
  EXPECT_THAT(read_two(axis(2000.0, 1e-3 * kG)).doubts,
              ElementsAre(testing::AllOf(HasSubstr("y.csv"), HasSubstr("is not that of a tool; if it is in mg"))));
}

TEST_F(StrokeImport, IsTheSameFromItsFolder) {
  const Stroke stroke = read(MadeStroke{}).stroke;
  const auto folder = dir_ / "stroke";
  std::filesystem::create_directory(folder);
  write_stroke(folder, stroke, {});
  const Stroke again = read_stroke_folder(folder);
  EXPECT_EQ(again.acceleration_mps2, stroke.acceleration_mps2);
  EXPECT_EQ(again.speed_mps, stroke.speed_mps);
  EXPECT_EQ(again.force_N, stroke.force_N);
  EXPECT_EQ(again.rate_Hz, stroke.rate_Hz);
  EXPECT_TRUE(again.speed_is_measured && again.force_is_measured);
  std::string text = read_file(folder / "stroke.csv", 1U << 30U);
  text[text.find('\n') + 1] = '9';
  write_file(folder / "stroke.csv", text);
  EXPECT_THROW(read_stroke_folder(folder), Error);
}

TEST(JoinAxes, KeepsThePowerOfAllAxes) {
  for (const std::size_t n : {1000U, 1001U}) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> axes(3, std::vector<double>(n));
    double power = 0.0;
    for (auto& axis : axes) {
      double mean = 0.0;
      for (double& v : axis) mean += (v = 5.0 + normal(random)) / static_cast<double>(n);
      for (const double v : axis) power += (v - mean) * (v - mean);
    }
    double joined = 0.0;
    for (const double v : join_axes(axes)) joined += v * v;
    EXPECT_NEAR(joined, power, 1e-9 * power);
  }
}

}  // namespace
}  // namespace asperity

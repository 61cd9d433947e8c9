#include <gmock/gmock.h>

#include <string>

#include "asperity/base/error.h"
#include "asperity/recording/parse_recording.h"

namespace asperity {
namespace {

// A good calibration with one value exchanged.
std::string with(const std::string& from, const std::string& to) {
  std::string text = R"({"format":"asperity-calibration","version":1,
"accelerometer":{"model":"linear","B":[[800,0,0],[0,800,0],[0,0,800]],"C":[32768,32768,32768],"position_in_marker_m":[0,0.07,0]},
"gyroscope":{"B":[[938,0,0],[0,938,0],[0,0,938]],"C":[32768,32768,32768]},
"force":{"newton_per_count":0.001,"offset_newton":-2},
"tip_in_marker_m":[0,0.12,0],
"tracker":{"sigma_position_m":[1e-4,1e-4,3e-4],"sigma_rotation_rad":[3e-3,3e-3,3e-3],"latency_s":0.012}})";
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return from.empty() ? text : text.replace(at, from.size(), to);
}

TEST(PlausibleCalibration, UnsignedConvertersAreRead) {
  const Calibration calibration = parse_calibration(with("", ""), "calibration.json");
  EXPECT_EQ(calibration.gyroscope->C[0], 32768.0);
}

// Finite but absurd: refused with the file, the field and the value.
TEST(PlausibleCalibration, AbsurdValuesAreNamed) {
  struct Case {
    const char *from, *to, *field, *value;
  };
  for (const Case& one :
       {Case{"[0,0,938]],\"C\":[32768", "[0,0,938]],\"C\":[1e20", "gyroscope", "1e+20"},
        Case{"[0,0,800]],\"C\":[32768", "[0,0,800]],\"C\":[-1e20", "accelerometer", "-1e+20"},
        Case{"[[800,0,0],[0,800,0],[0,0,800]]", "[[1e20,0,0],[0,1e20,0],[0,0,1e20]]", "accelerometer.B", "1e+20"},
        Case{"[[800,0,0],[0,800,0],[0,0,800]]", "[[1e-9,0,0],[0,1e-9,0],[0,0,1e-9]]", "accelerometer.B", "1e-09"},
        Case{"[[938,0,0],", "[[0.5,0,0],", "gyroscope.B", "0.5"},
        Case{"[0,0.12,0]", "[0,120,0]", "tip_in_marker_m", "120"},
        Case{"[0,0.07,0]", "[0,70,0]", "position_in_marker_m", "70"},
        Case{"\"latency_s\":0.012", "\"latency_s\":12", "latency_s", "12"},
        Case{"[1e-4,1e-4,3e-4]", "[1e-4,1e4,3e-4]", "sigma_position_m", "10000"},
        Case{"0.001,", "1e20,", "newton_per_count", "1e+20"}, Case{"-2}", "-2e9}", "offset_newton", "-2000000000"}}) {
    try {
      parse_calibration(with(one.from, one.to), "calibration.json");
      ADD_FAILURE() << "not refused: " << one.to;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("calibration.json")) << one.to;
      EXPECT_THAT(error.what(), testing::HasSubstr(one.field)) << one.to;
      EXPECT_THAT(error.what(), testing::HasSubstr(one.value)) << one.to;
    }
  }
}

}  // namespace
}  // namespace asperity

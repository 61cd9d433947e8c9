// Settings by the names that they had before (docs/names.md): with --set and in a file. Only the present names are
// written.
#include <gmock/gmock.h>
#include <string>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "run_asperity.h"

namespace asperity::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Renamed {
  std::vector<std::string> command;
  const char* group;
  const char* former;
  const char* present;
  const char* value;  // not the default
};

class FormerNames : public testing::TestWithParam<Renamed> {};

TEST_P(FormerNames, AreReadWithSetAndFromAFile) {
  const Renamed& r = GetParam();
  const std::string written = std::string("\n") + r.present + " = " + r.value + "\n";
  const std::string group = r.group;

  const auto printed = [&r](const char* option, const std::string& value) {
    std::vector<std::string> words = r.command;
    words.insert(words.end(), {"--print-config", option, value});
    return run(words);
  };
  const Outcome by_set = printed("--set", group + "." + r.former + "=" + r.value);
  EXPECT_EQ(by_set.code, 0) << by_set.err;
  EXPECT_THAT(by_set.out, HasSubstr(written));
  EXPECT_THAT(by_set.out, Not(HasSubstr(std::string("\n") + r.former + " =")));

  const testkit::TempDir folder;
  const std::string file = (folder / "old.toml").string();
  write_text(file, "[" + group + "]\n" + r.former + " = " + r.value + "\n");
  const Outcome by_file = printed("--config", file);
  EXPECT_EQ(by_file.code, 0) << by_file.err;
  EXPECT_EQ(by_file.out, by_set.out);
}

INSTANTIATE_TEST_SUITE_P(
    All, FormerNames,
    testing::Values(Renamed{{"process"}, "fused", "accel_bias_walk_mps2_rts", "accel_bias_walk_mps2_per_rts", "0.0125"},
                    Renamed{{"process"}, "fused", "gyro_bias_walk_radps_rts", "gyro_bias_walk_radps_per_rts", "0.0125"},
                    Renamed{
                        {"process"}, "fused", "angular_accel_radps2_rtHz", "angular_accel_radps2_per_rtHz", "0.125"},
                    Renamed{{"process"}, "base.arc_length", "along_cutoff_hz", "along_cutoff_Hz", "12.5"},
                    Renamed{{"process"}, "stiffness", "high_hz", "high_Hz", "6.5"},
                    Renamed{{"register"}, "process.stiffness", "high_hz", "high_Hz", "6.5"},
                    Renamed{{"simulate"}, "hand", "normal_damping_Ns_per_m", "normal_damping_N_s_per_m", "5.5"},
                    Renamed{{"simulate"}, "hand", "tangential_damping_Ns_per_m", "tangential_damping_N_s_per_m", "5.5"},
                    Renamed{{"feel"}, "stroke", "turn_s", "speed_ramp_s", "0.25"},
                    Renamed{{"feel"}, "score", "poor", "min_score", "0.25"},
                    Renamed{{"feel"}, "score", "least_touched", "min_contact_fraction", "0.25"},
                    Renamed{{"texture", "fit"}, "stochastic", "use_grain", "use_correlation_length", "false"}));

}  // namespace
}  // namespace asperity::cli

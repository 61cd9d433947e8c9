// The servo thread of the program, paced, with a scene of each texture model: no allocation, no mapping of memory, no
// lock and no page fault between its 200th wait and its last. Counted from outside (servo_shim.c), Eigen's and the
// C library's own included.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "asperity/testkit/temp_dir.h"
#include "plane_obj.h"
#include "run_asperity.h"
#include "servo_counts.h"

namespace asperity::cli {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Felt {
  const char* name;
  Words fit;   // how the texture is made; @ stands for the inputs
  Words feel;  // further options
};

void PrintTo(const Felt& felt, std::ostream* out) { *out << felt.name; }

class ServoCalls : public testing::TestWithParam<Felt> {};

const fs::path& inputs() {
  static const testkit::TempDir dir;
  static const fs::path path = [] {
    const fs::path folder = dir.path();
    run({"simulate", "--surface", "sandpaper", "--seed", "3", "--set", "hand.length_m=0.04", "-o", folder / "rec",
         "--quiet"});
    run({"process", folder / "rec", "-o", folder / "processed", "--quiet"});
    write_text(folder / "plane.obj", plane_obj());
    // Taps at two speeds and forces: 150 Hz that decay within 20 ms.
    for (int tap = 0; tap < 4; ++tap) {
      const double speed_mps = 0.05 + 0.05 * (tap % 2), force_N = tap < 2 ? 0.5 : 1.0;
      std::string rows = "t_s,acceleration_mps2,speed_mps,force_N\n";
      for (int i = 0; i < 400; ++i) {
        const double t_s = 2.5e-4 * i;
        const double a =
            40.0 * speed_mps * force_N * std::exp(-t_s / 0.02) * std::sin(2.0 * std::numbers::pi * 150.0 * t_s);
        rows += std::to_string(t_s) + "," + std::to_string(a) + "," + std::to_string(speed_mps) + "," +
                std::to_string(force_N) + "\n";
      }
      write_text(folder / ("tap_" + std::to_string(tap) + ".csv"), rows);
    }
    return folder;
  }();
  return path;
}

TEST_P(ServoCalls, NoneThatCouldBlock) {
  const testkit::TempDir dir;
  Words fit{"texture", "fit"};
  for (std::string word : GetParam().fit) {
    if (word.starts_with('@')) word = inputs().string() + word.substr(1);
    fit.push_back(word);
  }
  for (const std::string& word : Words{"-o", dir / "x.texture.json", "--quiet"}) fit.push_back(word);
  const Outcome fitted = run(fit);
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const Outcome painted = run({"paint", inputs() / "plane.obj", "--through", "5,7,0;35,7,0", "--texture",
                               dir / "x.texture.json", "--mesh-unit", "mm", "-o", dir / "scene", "--quiet"});
  ASSERT_EQ(painted.code, 0) << painted.err;
  Words feel{"feel", dir / "scene", "--realtime", "--duration", "1.2s", "--quiet", "-o", dir / "felt"};
  feel.insert(feel.end(), GetParam().feel.begin(), GetParam().feel.end());
  const auto count = [&] {
    ::setenv("LD_PRELOAD", SERVO_SHIM, 1);
    ::setenv("SERVO_COUNTS", (dir / "counts").c_str(), 1);
    const Outcome felt = run(feel);
    ::unsetenv("LD_PRELOAD");
    ::unsetenv("SERVO_COUNTS");
    EXPECT_TRUE(felt.code == 0 || felt.code == 3) << felt.err;
    fs::remove_all(dir / "felt");
    return read_servo_counts(dir / "counts");
  };
  expect_no_call_that_could_block(count, 300);  // of some 1000 waits
}

TEST(ServoMemory, ThatCannotBeLockedIsToldWithItsRemedy) {
  const testkit::TempDir dir;
  write_text(dir / "plane.obj", plane_obj());
  ::setenv("LD_PRELOAD", SERVO_SHIM, 1);
  ::setenv("SERVO_NO_LOCK", "1", 1);
  const Outcome felt = run({"feel", dir / "plane.obj", "--mesh-unit", "mm", "--realtime", "--duration", "0.2s"});
  ::unsetenv("LD_PRELOAD");
  ::unsetenv("SERVO_NO_LOCK");
  const std::string told = felt.out + felt.err;
  EXPECT_NE(told.find("memory     not locked (Cannot allocate memory)"), std::string::npos) << told;
  EXPECT_NE(told.find("raise the limit by `ulimit -l unlimited`, or memlock in /etc/security/limits.conf"),
            std::string::npos)
      << told;
}

INSTANTIATE_TEST_SUITE_P(
    Textures, ServoCalls,
    testing::Values(Felt{"fourier1d", {"@/processed/profile.csv"}, {}},
                    Felt{
                        "normal_perturbation", {"@/processed/profile.csv"}, {"--texture-model", "normal-perturbation"}},
                    Felt{"lateral_gradient", {"@/processed/profile.csv"}, {"--texture-model", "lateral-gradient"}},
                    Felt{"fourier2d", {"@/processed/profile.csv", "--model", "fourier2d"}, {}},
                    Felt{"heightmap", {"@/processed/profile.csv", "--model", "heightmap"}, {}},
                    Felt{"stochastic", {"@/processed/profile.csv", "--model", "stochastic"}, {}},
                    Felt{"autoregressive", {"@/rec", "--model", "autoregressive"}, {}},
                    Felt{"decaying_sinusoids",
                         {"@/tap_0.csv", "@/tap_1.csv", "@/tap_2.csv", "@/tap_3.csv", "--model", "decaying_sinusoids"},
                         {}}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace asperity::cli

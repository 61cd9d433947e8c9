// The vibration functions of asperity_feel.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <asperity_feel.h>
#include "asperity/testkit/count_allocations.h"

namespace asperity {
namespace {

constexpr double kRate_Hz = 1000.0;

struct Levels {
  double slow = -1.0, fast = -1.0;
};

// One motor's filters, freed at the end.
class Rumble {
 public:
  explicit Rumble(double full_scale_N) {
    EXPECT_EQ(asperity_rumble_create(kRate_Hz, full_scale_N, &rumble_), ASPERITY_OK) << asperity_last_error();
  }
  ~Rumble() { asperity_rumble_free(rumble_); }
  Rumble(const Rumble&) = delete;
  Rumble& operator=(const Rumble&) = delete;

  void add(const std::vector<double>& force_N) {
    for (const double f : force_N) asperity_rumble_add(rumble_, f);
  }
  Levels take() {
    Levels levels;
    asperity_rumble_take(rumble_, &levels.slow, &levels.fast);
    return levels;
  }
  asperity_rumble* get() { return rumble_; }

 private:
  asperity_rumble* rumble_ = nullptr;
};

// A static force with a sine on it.
std::vector<double> forces(double static_N, double amplitude_N, double frequency_Hz, std::size_t count) {
  std::vector<double> result(count);
  for (std::size_t i = 0; i < count; ++i)
    result[i] =
        static_N + amplitude_N * std::sin(2.0 * std::numbers::pi * frequency_Hz * static_cast<double>(i) / kRate_Hz);
  return result;
}

// What steps of a tip give that is pressed 1 mm into a plate of 500 N/m and stays there.
std::vector<double> resting_hand(std::size_t count) {
  const std::array<double, 12> vertices_m{0.0, 0.0, 0.0, 0.04, 0.0, 0.0, 0.04, 0.04, 0.0, 0.0, 0.04, 0.0};
  const std::array<unsigned, 6> triangles{0, 1, 2, 0, 2, 3};
  asperity_scene* scene = nullptr;
  asperity_feel* feel = nullptr;
  EXPECT_EQ(asperity_scene_from_mesh(vertices_m.data(), 4, triangles.data(), 2, &scene), ASPERITY_OK);
  EXPECT_EQ(asperity_scene_set_stiffness(scene, 500.0), ASPERITY_OK);
  EXPECT_EQ(asperity_feel_create(scene, nullptr, &feel), ASPERITY_OK) << asperity_last_error();
  asperity_motion motion;
  asperity_touch touch;
  asperity_motion_init(&motion, sizeof motion);
  asperity_touch_init(&touch, sizeof touch);
  motion.dt_s = 1.0 / kRate_Hz;
  motion.position_m[0] = motion.position_m[1] = 0.02;
  std::vector<double> vibration_N;
  for (std::size_t i = 0; i < count; ++i) {
    const double down_m = std::min(2e-3, 4e-6 * static_cast<double>(i));  // for half a second, then it rests
    motion.position_m[2] = 1e-3 - down_m;
    motion.velocity_mps[2] = down_m < 2e-3 ? -4e-3 : 0.0;
    EXPECT_EQ(asperity_feel_step(feel, &motion, &touch), ASPERITY_OK);
    vibration_N.push_back(touch.vibration_N);
  }
  EXPECT_GT(touch.force_N[2], 0.4) << "the hand presses";
  asperity_feel_free(feel);
  asperity_scene_free(scene);
  return vibration_N;
}

TEST(CLibraryVibration, SamplesAreOfTheSoundAndRumbleIsTheLevel) {
  std::vector<double> force_N(500);
  for (std::size_t i = 0; i < force_N.size(); ++i)
    force_N[i] = 0.2 * std::sin(0.2 * 3.14159265 * static_cast<double>(i));
  std::size_t count = 0;
  ASSERT_EQ(asperity_vibration_samples(force_N.data(), force_N.size(), 1000.0, 48000.0, 1.0, 1.0, nullptr, 0, &count),
            ASPERITY_OK)
      << asperity_last_error();
  EXPECT_EQ(count, 24000u);
  std::vector<float> samples(count + 5, 9.0F);
  ASSERT_EQ(asperity_vibration_samples(force_N.data(), force_N.size(), 1000.0, 48000.0, 1.0, 1.0, samples.data(), 100,
                                       &count),
            ASPERITY_OK);
  EXPECT_EQ(count, 100u);
  EXPECT_EQ(samples[100], 9.0F);
  ASSERT_EQ(asperity_vibration_samples(force_N.data(), force_N.size(), 1000.0, 48000.0, 1.0, 1.0, samples.data(),
                                       samples.size(), &count),
            ASPERITY_OK);
  float highest = 0.0F;
  for (std::size_t i = 6000; i < 18000; ++i) highest = std::max(highest, samples[i]);
  EXPECT_NEAR(highest, 0.2F, 0.01F);  // 100 Hz passes whole
  EXPECT_EQ(asperity_vibration_samples(force_N.data(), force_N.size(), 1.0, 48000.0, 1.0, 1.0, nullptr, 0, &count),
            ASPERITY_BAD_ARGUMENT);
  EXPECT_EQ(asperity_vibration_samples(force_N.data(), static_cast<std::size_t>(-1), 1000.0, 48000.0, 1.0, 1.0, nullptr,
                                       0, &count),
            ASPERITY_BAD_ARGUMENT);
  EXPECT_NEAR(asperity_vibration_rumble(force_N.data(), force_N.size(), 1.0), 0.2 / std::sqrt(2.0), 1e-3);
  for (std::size_t i = 0; i < force_N.size(); ++i) force_N[i] += 3.0 + 1e-3 * static_cast<double>(i);
  EXPECT_NEAR(asperity_vibration_rumble(force_N.data(), force_N.size(), 1.0), 0.2 / std::sqrt(2.0), 1e-3)
      << "of a hand that presses, and presses harder, only the vibration counts";
  const std::vector<double> rest(100, 0.5);
  EXPECT_NEAR(asperity_vibration_rumble(rest.data(), rest.size(), 0.5), 0.0, 1e-12);
  EXPECT_EQ(asperity_vibration_rumble(force_N.data(), force_N.size(), 1e-3), 1.0);
  EXPECT_EQ(asperity_vibration_rumble(rest.data(), 1, 0.5), 0.0) << "one force has no vibration";
  EXPECT_EQ(asperity_vibration_rumble(nullptr, 3, 1.0), 0.0);
}

// A motor at full strength in a hand that rests hurts it, and hides the texture.
TEST(CLibraryRumble, AHandThatRestsFeelsNothing) {
  const std::vector<double> vibration_N = resting_hand(3000);
  EXPECT_GT(std::abs(vibration_N.back()), 0.4) << "the number itself has the static force";
  Rumble rumble(0.5);
  rumble.add(vibration_N);
  rumble.take();
  rumble.add(std::vector<double>(vibration_N.end() - 1000, vibration_N.end()));
  const Levels levels = rumble.take();
  EXPECT_NEAR(levels.slow, 0.0, 1e-6);
  EXPECT_NEAR(levels.fast, 0.0, 1e-6);
  EXPECT_NEAR(asperity_vibration_rumble(vibration_N.data() + 2000, 1000, 0.5), 0.0, 1e-6);
}

// Second-order Butterworth sections in series, by their closed forms at the prewarped frequencies.
TEST(CLibraryRumble, EachMotorHasItsBandsAmplitude) {
  const auto warped = [](double f_Hz) { return std::tan(std::numbers::pi * f_Hz / kRate_Hz); };
  const auto high = [&](double f_Hz, double cut_Hz) {
    return 1.0 / std::sqrt(1.0 + std::pow(warped(cut_Hz) / warped(f_Hz), 4.0));
  };
  const auto low = [&](double f_Hz, double cut_Hz) {
    return 1.0 / std::sqrt(1.0 + std::pow(warped(f_Hz) / warped(cut_Hz), 4.0));
  };
  for (const double f_Hz : {5.0, 40.0, 100.0, 250.0}) {
    Rumble rumble(0.5);
    rumble.add(forces(2.0, 0.2, f_Hz, 2000));
    rumble.take();
    rumble.add(forces(2.0, 0.2, f_Hz, 1000));  // whole periods, so the phase continues
    const Levels levels = rumble.take();
    EXPECT_NEAR(levels.slow, 0.4 * high(f_Hz, 20.0) * low(f_Hz, 100.0), 1e-4) << f_Hz;
    EXPECT_NEAR(levels.fast, 0.4 * high(f_Hz, 20.0) * high(f_Hz, 100.0), 1e-4) << f_Hz;
  }
}

TEST(CLibraryRumble, NeverLeavesItsRangeAndStopsWithoutForces) {
  Rumble rumble(1e-3);
  rumble.add({1e300, -1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 5.0});
  for (int i = 0; i < 3; ++i) {
    const Levels levels = rumble.take();
    EXPECT_TRUE(levels.slow >= 0.0 && levels.slow <= 1.0) << levels.slow;
    EXPECT_TRUE(levels.fast >= 0.0 && levels.fast <= 1.0) << levels.fast;
    if (i > 0) {
      EXPECT_EQ(levels.slow + levels.fast, 0.0);
    }
  }
}

// A tracker's jump: one huge force, then the hand rests again.
TEST(CLibraryRumble, AHugeForceIsOverWithinATenthOfASecond) {
  for (const double huge_N : {1e9, 1e300, -1.7e308}) {
    Rumble rumble(1.0);
    rumble.add(std::vector<double>(500, 1.0));
    rumble.add({huge_N});
    rumble.add(std::vector<double>(150, 1.0));
    rumble.take();
    rumble.add(std::vector<double>(100, 1.0));
    const Levels levels = rumble.take();
    EXPECT_LT(levels.slow, 0.05) << huge_N;
    EXPECT_LT(levels.fast, 0.05) << huge_N;
    rumble.add(forces(1.0, 0.5, 40.0, 500));
    EXPECT_GT(rumble.take().slow, 0.3) << "it goes on to vibrate";
  }
}

TEST(CLibraryRumble, AfterAResetTheFirstForceIsNoTap) {
  Rumble rumble(0.5);
  rumble.add(std::vector<double>(100, 2.0));
  EXPECT_GT(rumble.take().slow, 0.1) << "the first touch of a free hand is felt";
  asperity_rumble_reset(rumble.get());
  rumble.add(std::vector<double>(100, 1.0));
  const Levels levels = rumble.take();
  EXPECT_NEAR(levels.slow + levels.fast, 0.0, 1e-9);
}

TEST(CLibraryRumble, AllocatesNothingAndRefusesWhatCannotBe) {
  Rumble rumble(0.5);
  Levels levels;
  const std::size_t before = testkit::count_own_allocations();
  for (int i = 0; i < 100; ++i) asperity_rumble_add(rumble.get(), 0.1 * i);
  asperity_rumble_take(rumble.get(), &levels.slow, &levels.fast);
  asperity_rumble_reset(rumble.get());
  EXPECT_EQ(testkit::count_own_allocations(), before);

  auto* none = rumble.get();
  for (const auto& [rate_Hz, full_N] :
       {std::pair{0.0, 0.5}, {1e9, 0.5}, {std::nan(""), 0.5}, {1000.0, 0.0}, {1000.0, std::nan("")}}) {
    EXPECT_EQ(asperity_rumble_create(rate_Hz, full_N, &none), ASPERITY_BAD_ARGUMENT);
    EXPECT_EQ(none, nullptr);
  }
  EXPECT_EQ(asperity_rumble_create(1000.0, 0.5, nullptr), ASPERITY_BAD_ARGUMENT);
  asperity_rumble_add(nullptr, 1.0);
  asperity_rumble_take(nullptr, &levels.slow, &levels.fast);
  EXPECT_EQ(levels.slow + levels.fast, 0.0);
  asperity_rumble_reset(nullptr);
  asperity_rumble_free(nullptr);
}

}  // namespace
}  // namespace asperity

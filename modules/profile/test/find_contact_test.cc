#include "asperity/profile/find_contact.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

// 1 kHz, the force read at every fourth sample.
TipMotion with_force(const std::function<double(double)>& force_N) {
  TipMotion out;
  for (int i = 0; i < 2000; ++i) {
    out.t_ns.push_back(i * 1'000'000LL);
    out.force_N.push_back(i % 4 == 0 ? force_N(i * 1e-3) : NAN);
  }
  return out;
}

TEST(FindContact, KeepsShortFlightsAndLeavesOutLongOnesWithTheirMargins) {
  const TipMotion motion = with_force([](double t) {
    const bool flight = t > 0.5 && t<0.512, lift = t> 1.0 && t < 1.2, approach = t < 0.2;
    return flight || lift || approach ? 0.0 : 1.0;
  });
  const std::vector<char> contact = find_contact(motion, {});
  EXPECT_EQ(contact[100], 0);
  EXPECT_EQ(contact[210], 0);  // within 20 ms of the first touch
  EXPECT_EQ(contact[240], 1);
  EXPECT_EQ(contact[506], 1);
  EXPECT_EQ(contact[990], 0);
  EXPECT_EQ(contact[1100], 0);
  EXPECT_EQ(contact[1215], 0);
  EXPECT_EQ(contact[1240], 1);
  EXPECT_EQ(contact[970], 1);
}

TEST(FindContact, TheTwoThresholdsAreAHysteresis) {
  ContactConfig config;
  config.margin_s = 0.0;
  config.max_flight_s = 0.0;
  const TipMotion motion = with_force([](double t) { return t < 1.0 ? 0.1 : t < 1.2 ? 0.5 : 0.1; });
  const std::vector<char> contact = find_contact(motion, config);
  EXPECT_EQ(contact[1100], 1);
  EXPECT_EQ(contact[1900], 1);  // 0.1 N is above the release threshold
}

TEST(FindContact, WithoutAForceEverythingTouches) {
  TipMotion motion = with_force([](double) { return NAN; });
  for (const char c : find_contact(motion, {})) EXPECT_EQ(c, 1);
  ContactConfig config;
  config.release_N = 1.0;
  EXPECT_THROW(find_contact(motion, config), Error);
}

}  // namespace
}  // namespace asperity

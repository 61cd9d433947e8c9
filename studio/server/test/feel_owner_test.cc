// Who may command a force, and what others may not change meanwhile.
#include <gmock/gmock.h>

#include "feel/feel_page.h"
#include "feel_rig.h"

namespace asperity::studio {

using testing::HasSubstr;

TEST(FeelPage, OnlyTheOwnerOfTheForceMovesThePointer) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  const Pointer elsewhere{0, {0.5, 0.5, 0.5}};
  const std::size_t before = rig.hub.ticks().size();
  EXPECT_TRUE(rig.wait([&] {
    rig.page->pointed(FeelRig::kOwner + 1, elsewhere);
    return rig.hub.ticks().size() > before + 200 && rig.hub.newest().out_N > 0.3;
  }));
}

TEST(FeelPage, WhoMayNotCommandForcesIsToldSo) {
  FeelRig rig(false);
  rig.choose_height_maps();
  rig.document.edit("/feel/device", "haply", "device");
  const FakeHub::Answer answer = rig.call("feel.start");
  EXPECT_THAT(answer.error, HasSubstr("does not command forces"));
  EXPECT_THAT(answer.hint, HasSubstr("--remote-force"));
  // The modelled hand is shown; nothing is let through.
  rig.document.edit("/feel/device", "sim", "device");
  EXPECT_EQ(rig.call("feel.start").error, "");
  EXPECT_TRUE(rig.wait([&] { return rig.hub.newest().rendered_N > 0.1; }));
  for (const FeelHub::Tick& tick : rig.hub.ticks()) ASSERT_EQ(tick.out_N, 0.0);
}

TEST(FeelPage, AnotherWindowThatHasTheForceKeepsIt) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  EXPECT_THAT(rig.call("feel.start", Json::object(), FeelRig::kOwner + 1).error, HasSubstr("another window"));
  EXPECT_EQ(rig.call("feel.start").error, "");
  EXPECT_THAT(rig.call("feel.start").error, HasSubstr("already"));
}

// The one who acquires the lease after the owner's silence does not bring the force back to the owner's hand.
TEST(FeelPage, ARunBelongsToTheOneWhoStartedIt) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  ASSERT_EQ(rig.call("feel.start").error, "");
  rig.touch();
  constexpr ClientId kOther = FeelRig::kOwner + 1;
  rig.lease.release(FeelRig::kOwner);
  rig.beating = {kOther};
  EXPECT_TRUE(rig.wait([&] { return rig.hub.newest().out_N == 0.0; }));
  const std::size_t ticks = rig.hub.ticks().size();
  EXPECT_TRUE(rig.wait([&] { return rig.hub.ticks().size() > ticks + 300; }));
  const std::vector<FeelHub::Tick> silent = rig.hub.ticks();
  for (std::size_t k = ticks; k < silent.size(); ++k) ASSERT_EQ(silent[k].out_N, 0.0);
  // By its own request it may take it over.
  EXPECT_NE(rig.call("feel.take", Json::object(), FeelRig::kOwner).error, "");
  EXPECT_EQ(rig.call("feel.take", Json::object(), kOther).error, "");
  EXPECT_EQ(rig.status()["owner"], kOther);
  EXPECT_TRUE(rig.wait([&] {
    rig.page->pointed(kOther, Pointer{0, {0.007, 0.017, -0.004}});
    return rig.hub.newest().out_N > 0.3;
  }));
}

TEST(FeelPage, OthersChangeNothingUnderAHandButTheLargestForceDownwards) {
  FeelRig rig;
  rig.choose_height_maps();
  rig.own_force();
  constexpr ClientId kOther = FeelRig::kOwner + 1;
  const auto may = [&](ClientId client, const char* path, const Json& value) {
    try {
      rig.page->check_edit(client, Edit{path, Json(), value, "", ""});
      return true;
    } catch (const Advice&) {
      return false;
    }
  };
  EXPECT_TRUE(may(kOther, "/feel/settings/render.friction", 0.4));
  ASSERT_EQ(rig.call("feel.start").error, "");
  EXPECT_TRUE(may(FeelRig::kOwner, "/feel/settings/render.friction", 0.4));
  EXPECT_TRUE(may(FeelRig::kOwner, "/feel/max_force_N", 3.0));
  for (const char* path : {"/feel/settings/render.friction", "/feel/scene", "/feel", "/feel/device"}) {
    EXPECT_FALSE(may(kOther, path, 0.4)) << path;
  }
  EXPECT_TRUE(may(kOther, "/paint/object", "plate.obj"));
  EXPECT_TRUE(may(kOther, "/feel/max_force_N", 2.0));
  rig.document.edit("/feel/max_force_N", 2.0, "limit");
  EXPECT_FALSE(may(kOther, "/feel/max_force_N", 3.0));
  EXPECT_FALSE(may(kOther, "/feel/max_force_N", Json()));
}

}  // namespace asperity::studio

#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "asperity/base/host_clock.h"
#include "asperity/testkit/temp_dir.h"
#include "feel_rig.h"
#include "study/study_page.h"

namespace asperity::studio {

// The Feel and Study pages with all that they share, on the test's thread; in a folder that outlives them.
class StudyRig {
 public:
  explicit StudyRig(const std::filesystem::path& folder) : project(folder) {
    feel.bind(document, calls);
    study.bind(document, calls);
    jobs.bind(calls);
    document.load();
    document.on_change([this](const Edit& edit) { feel.edited(edit); });
    feel.start();
    study.start();
  }
  ~StudyRig() {
    study.stop();
    feel.stop();
  }
  StudyRig(const StudyRig&) = delete;
  StudyRig& operator=(const StudyRig&) = delete;

  bool pump(const std::function<bool()>& done) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!done()) {
      if (std::chrono::steady_clock::now() > until) return false;
      for (const auto& work : inbox.wait(std::chrono::steady_clock::now() + std::chrono::milliseconds(2))) work();
      feel.tick(host_now_ns());
      if (beating) lease.acquire(kOwner, host_now_ns());
      if (pointing) feel.pointed(kOwner, Pointer{0, {pointer_m.x(), pointer_m.y(), pointer_m.z()}});
    }
    return true;
  }

  FakeHub::Answer ask(const std::string& name, Json args = Json::object(), ClientId client = kOwner) {
    Call call;
    call.id = ++id;
    call.name = name;
    call.args = std::move(args);
    calls.dispatch(Request(hub, client, call));
    EXPECT_TRUE(pump([&] { return hub.answered(call.id); })) << name;
    return hub.answer_to(call.id);
  }
  Json status() { return ask("study.status").result; }
  Json session() { return status()["session"]; }

  // A study of the first tiles, for a participant.
  void set_up(const std::string& method, int stimuli) {
    Json names = Json::array();
    for (int k = 0; k < stimuli; ++k) names.push_back("tile" + std::to_string(k) + ".pgm");
    document.edit("/study/study/stimuli", names, "textures");
    document.edit("/study/study/method", method, "method");
    document.edit("/study/study/break_every", 0, "no breaks");
    document.edit("/study/participant", "p01", "participant");
  }
  // Starts the touch, and waits until the trial can be rendered.
  void touch() {
    beating = true;
    EXPECT_TRUE(pump([&] { return lease.owner(host_now_ns()) == kOwner; }));
    EXPECT_EQ(ask("study.touch", {{"on", true}}).error, "");
    EXPECT_TRUE(pump([&] { return session()["ready"].get<bool>(); }));
  }
  // Presses into one tile until that counts as touched.
  void press(bool right) {
    const double tile_m = 0.030, gap_m = 0.004;  // the defaults of StudyPresentation
    const double x_m = gap_m + (right ? 1.5 * tile_m + gap_m : 0.5 * tile_m);
    pointing = true;
    pointer_m = {x_m, 0.019, 0.004};
    const std::int64_t until_ns = host_now_ns() + 200'000'000;
    EXPECT_TRUE(pump([&] { return host_now_ns() > until_ns; }));
    pointer_m.z() = -0.004;
    EXPECT_TRUE(pump([&] { return session()[right ? "touched_b" : "touched_a"].get<bool>(); }));
  }
  // Both tiles, or the only one of a rating.
  void press_all() {
    press(false);
    if (session()["method"] != "rating") press(true);
  }
  FakeHub::Answer answer(int value) {
    EXPECT_TRUE(pump([&] { return session()["ready"].get<bool>(); }));
    press_all();
    return ask("study.answer", {{"trial", session()["trial"]}, {"answer", value}});
  }

  static constexpr ClientId kOwner = 7;
  FeelHub hub;
  Inbox inbox;
  Project project;
  Document document{project.folder() / ".asperity-studio.json"};
  ForceLease lease;
  Calls calls;
  Jobs jobs{hub, [this](Inbox::Work work) { inbox.post(std::move(work)); }};
  Shared shared{hub, project, document, jobs, lease, true, [this](Inbox::Work work) { inbox.post(std::move(work)); }};
  FeelPage feel{shared, FeelRig::config()};
  StudyPage study{shared, feel, FeelRig::config()};
  bool beating = false, pointing = false;
  Eigen::Vector3d pointer_m = Eigen::Vector3d::Zero();
  std::uint64_t id = 0;
};

}  // namespace asperity::studio

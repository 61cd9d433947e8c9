#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "asperity/base/host_clock.h"
#include "asperity/studio/page.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_hub.h"
#include "inbox.h"

namespace asperity::studio {

// What a page shares with the studio, in a folder of its own; the test is the studio's thread. `ItsHub` is a FakeHub
// that keeps what a browser would get.
template <class ItsHub = FakeHub>
class PageRig {
 public:
  static constexpr ClientId kClient = 7;

  PageRig() = default;
  // As the studio ends: nothing that still waits may run, for the page is going.
  virtual ~PageRig() {
    if (page) page->stop();
    jobs.reset();
    inbox.close();
  }
  PageRig(const PageRig&) = delete;
  PageRig& operator=(const PageRig&) = delete;

  // As the studio starts. Once.
  void open(std::unique_ptr<Page> made) {
    page = std::move(made);
    page->bind(document, calls);
    jobs->bind(calls);
    document.load();
    document.on_change([this](const Edit& edit) { page->edited(edit); });
    page->start();
  }

  // Runs the studio's thread until it is so; false after longer than a loaded machine takes.
  template <class Predicate>
  bool wait(const Predicate& so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!so()) {
      const auto now = std::chrono::steady_clock::now();
      if (now > end) return false;
      for (const auto& work : inbox.wait(now + std::chrono::milliseconds(2))) work();
      page->tick(host_now_ns());
      turned();
    }
    return true;
  }

  // A call's number, and what is answered to it.
  std::uint64_t begin(const std::string& name, Json args = Json::object(), ClientId client = kClient) {
    calls.dispatch(Request(hub, client, Call{++last_id_, name, std::move(args)}));
    return last_id_;
  }
  FakeHub::Answer answer_to(std::uint64_t id) {
    EXPECT_TRUE(wait([&] { return hub.answered(id); })) << "call " << id;
    return hub.answer_to(id);
  }
  FakeHub::Answer call(const std::string& name, Json args = Json::object(), ClientId client = kClient) {
    return answer_to(begin(name, std::move(args), client));
  }

  testkit::TempDir folder;
  ItsHub hub;
  Inbox inbox;
  Project project{folder.path()};
  Document document{folder / ".asperity-studio.json"};
  ForceLease lease;
  Calls calls;
  std::unique_ptr<Jobs> jobs = std::make_unique<Jobs>(hub, [this](Inbox::Work work) { inbox.post(std::move(work)); });
  Shared shared{hub, project, document, *jobs, lease, true, [this](Inbox::Work work) { inbox.post(std::move(work)); }};
  std::unique_ptr<Page> page;

 private:
  // After every turn of the studio's thread.
  virtual void turned() {}

  std::uint64_t last_id_ = 0;
};

}  // namespace asperity::studio

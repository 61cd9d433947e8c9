#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "asperity/studio/page.h"
#include "asperity/testkit/temp_dir.h"
#include "fake_hub.h"
#include "inbox.h"
#include "read_block.h"
#include "scan/scan_page.h"

namespace asperity::studio {

// A Scan page with all that it needs, in a folder of its own, and its studio's thread turned by hand.
class ScanBench {
 public:
  ScanBench() {
    page_->bind(document_, calls_);
    document_.load();
    document_.on_change([this](const Edit& edit) { page_->edited(edit); });
    page_->start();
  }
  ~ScanBench() {
    if (page_) page_->stop();
    jobs_.reset();  // before the page that they work for
  }
  ScanBench(const ScanBench&) = delete;
  ScanBench& operator=(const ScanBench&) = delete;

  std::filesystem::path folder() const { return folder_.path(); }
  FakeHub& hub() { return hub_; }
  void edit(const std::string& path, const Json& value) { document_.edit(path, value, "edit"); }
  void set(const std::string& setting, const std::string& value) { edit("/scan/settings/" + setting, value); }

  FakeHub::Answer call(const std::string& name, Json args = Json::object()) {
    const std::uint64_t id = ++last_id_;
    calls_.dispatch(Request(hub_, 1, Call{id, name, std::move(args)}));
    EXPECT_TRUE(wait([&] { return hub_.answered(id); })) << name;
    return hub_.answered(id) ? hub_.answer_to(id) : FakeHub::Answer{};
  }
  // The same, which has to go well.
  Json ask(const std::string& name, Json args = Json::object()) {
    const FakeHub::Answer answer = call(name, std::move(args));
    EXPECT_EQ(answer.error, "") << name;
    return answer.result;
  }

  // Turns the studio's thread until it is so; false after a minute.
  template <class Predicate>
  bool wait(const Predicate& so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!so()) {
      const auto now = std::chrono::steady_clock::now();
      if (now > end) return false;
      for (const auto& work : inbox_.wait(now + std::chrono::milliseconds(10))) work();
    }
    return true;
  }

  Json state() const {
    const std::vector<std::string> frames = hub_.frames("scan.state");
    return frames.empty() ? Json() : ReadBlock(frames.back()).head;
  }
  Json recorder() const {
    const Json now = state();
    return now.is_object() && now.contains("recorder") ? now.at("recorder") : Json();
  }
  bool storing() const {
    const Json now = recorder();
    return now.is_object() && now.at("storing").get<bool>();
  }
  std::size_t segments() const {
    const Json now = recorder();
    return now.is_object() ? now.at("segments").size() : 0;
  }
  // The refined profile; empty: there is none yet.
  std::string refined() const {
    const std::vector<std::string> frames = hub_.frames("scan.refined");
    return frames.empty() ? "" : frames.back();
  }

 private:
  testkit::TempDir folder_;
  FakeHub hub_;
  Inbox inbox_;
  Project project_{folder_.path()};
  Document document_{folder_ / ".asperity-studio.json"};
  Calls calls_;
  ForceLease lease_;
  std::unique_ptr<Jobs> jobs_ =
      std::make_unique<Jobs>(hub_, [this](Inbox::Work work) { inbox_.post(std::move(work)); });
  Shared shared_{
      hub_, project_, document_, *jobs_, lease_, true, [this](Inbox::Work work) { inbox_.post(std::move(work)); }};
  std::unique_ptr<Page> page_ = make_scan_page(shared_);
  std::uint64_t last_id_ = 0;
};

}  // namespace asperity::studio

#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "page_rig.h"
#include "read_block.h"
#include "scan/scan_page.h"

namespace asperity::studio {

// A Scan page, and what it last stated.
class ScanBench : public PageRig<> {
 public:
  ScanBench() { open(make_scan_page(shared)); }

  void edit(const std::string& path, const Json& value) { document.edit(path, value, "edit"); }
  void set(const std::string& setting, const std::string& value) { edit("/scan/settings/" + setting, value); }

  // A call that has to go well.
  Json ask(const std::string& name, Json args = Json::object()) {
    const FakeHub::Answer answer = call(name, std::move(args));
    EXPECT_EQ(answer.error, "") << name;
    return answer.result;
  }

  Json state() const {
    const std::vector<std::string> frames = hub.frames("scan.state");
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
    const std::vector<std::string> frames = hub.frames("scan.refined");
    return frames.empty() ? "" : frames.back();
  }
};

}  // namespace asperity::studio

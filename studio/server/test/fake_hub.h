#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "asperity/studio/hub.h"

namespace asperity::studio {

// Keeps what a browser would get. Thread-safe.
class FakeHub : public Hub {
 public:
  struct Answer {
    Json result;        // of answer()
    std::string block;  // of answer_block()
    std::string error, hint;
  };

  void publish(std::string_view topic, std::string frame, Delivery) override {
    const std::lock_guard lock(mutex_);
    frames_[std::string(topic)].push_back(std::move(frame));
  }
  bool has_subscribers(std::string_view) const override { return subscribed; }
  void broadcast(std::string_view event, const Json& data) override {
    const std::lock_guard lock(mutex_);
    events_.emplace_back(event, data);
  }
  void notify(ClientId, std::string_view event, const Json& data) override { broadcast(event, data); }
  void answer(ClientId, std::uint64_t id, const Json& result) override {
    const std::lock_guard lock(mutex_);
    answers_[id].result = result;
  }
  void answer_block(ClientId, std::uint64_t id, BlockWriter block) override {
    const std::lock_guard lock(mutex_);
    answers_[id].block = block.take();
  }
  void refuse(ClientId, std::uint64_t id, std::string_view message, std::string_view hint) override {
    const std::lock_guard lock(mutex_);
    answers_[id].error = message;
    answers_[id].hint = hint;
  }

  std::vector<std::string> frames(const std::string& topic) const {
    const std::lock_guard lock(mutex_);
    const auto found = frames_.find(topic);
    return found == frames_.end() ? std::vector<std::string>() : found->second;
  }
  std::vector<Json> events(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    std::vector<Json> out;
    for (const auto& [event, data] : events_) {
      if (event == name) out.push_back(data);
    }
    return out;
  }
  bool answered(std::uint64_t id) const {
    const std::lock_guard lock(mutex_);
    return answers_.contains(id);
  }
  Answer answer_to(std::uint64_t id) const {
    const std::lock_guard lock(mutex_);
    return answers_.at(id);
  }

  bool subscribed = true;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<std::string>> frames_;
  std::vector<std::pair<std::string, Json>> events_;
  std::map<std::uint64_t, Answer> answers_;
};

}  // namespace asperity::studio

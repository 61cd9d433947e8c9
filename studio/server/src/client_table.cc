#include "client_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "topic_name.h"

namespace asperity::studio {

namespace {

void check_topic(std::string_view topic) {
  if (!is_topic_name(topic)) throw Error("'" + printable(topic) + "' is not the name of a topic");
}

OutFrame shared_frame(std::string bytes, bool is_text) {
  return {std::make_shared<const std::string>(std::move(bytes)), is_text};
}

}  // namespace

std::optional<ClientId> ClientTable::join(Wake wake) {
  const std::lock_guard lock(mutex_);
  if (clients_.size() >= most_clients_) return std::nullopt;
  clients_[++last_id_].wake = std::move(wake);
  return last_id_;
}

bool ClientTable::leave(ClientId id) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end()) return false;
  for (const std::string& topic : found->second.topics) drop_topic(topic);
  clients_.erase(found);
  return true;
}

void ClientTable::drop_topic(const std::string& topic) {
  const auto count = subscribers_.find(topic);
  if (--count->second == 0) subscribers_.erase(count);
}

void ClientTable::subscribe(ClientId id, std::string_view topic) {
  check_topic(topic);
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end() || found->second.topics.contains(topic)) return;
  if (found->second.topics.size() >= kMostTopics) {
    throw Error(fmt::format("topic '{}': a browser can follow {} topics at most", topic, kMostTopics));
  }
  found->second.topics.emplace(topic);
  ++subscribers_[std::string(topic)];
}

void ClientTable::unsubscribe(ClientId id, std::string_view topic) {
  check_topic(topic);
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end() || found->second.topics.erase(std::string(topic)) == 0) return;
  found->second.outbox.forget(topic);
  drop_topic(std::string(topic));
}

bool ClientTable::has_subscribers(std::string_view topic) const {
  const std::lock_guard lock(mutex_);
  return subscribers_.contains(topic);
}

void ClientTable::rouse(Client& client) {
  if (std::exchange(client.awake, true)) return;
  client.wake();
}

void ClientTable::push(Client& client, const OutFrame& frame) {
  if (client.cut) return;
  if (client.outbox.push_message(frame)) return rouse(client);
  cut(client);
}

void ClientTable::cut(Client& client) {
  client.cut = true;
  client.outbox = {};
  // Woken even though it is being written to: that will not come to an end.
  client.wake();
}

void ClientTable::keep_within_memory() {
  for (;;) {
    std::size_t sum = 0;
    Client* most = nullptr;
    for (auto& [id, client] : clients_) {
      sum += client.outbox.message_bytes();
      if (most == nullptr || client.outbox.message_bytes() > most->outbox.message_bytes()) most = &client;
    }
    if (sum <= kMostMessageBytes) return;
    cut(*most);
  }
}

void ClientTable::publish(std::string_view topic, std::string bytes, Delivery delivery) {
  const OutFrame frame = shared_frame(std::move(bytes), false);
  const std::lock_guard lock(mutex_);
  if (!subscribers_.contains(topic)) return;
  for (auto& [id, client] : clients_) {
    if (client.cut || !client.topics.contains(topic)) continue;
    dropped_ += client.outbox.push_topic(topic, frame, delivery);
    rouse(client);
  }
}

void ClientTable::send_all(std::string text) {
  const OutFrame frame = shared_frame(std::move(text), true);
  const std::lock_guard lock(mutex_);
  for (auto& [id, client] : clients_) push(client, frame);
  keep_within_memory();
}

void ClientTable::send(ClientId id, std::string bytes, bool is_text) {
  const OutFrame frame = shared_frame(std::move(bytes), is_text);
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end()) return;
  push(found->second, frame);
  keep_within_memory();
}

bool ClientTable::begin_call(ClientId id, std::uint64_t call, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end() || found->second.unanswered.size() >= kMostUnanswered) return false;
  found->second.unanswered.emplace(call, bytes);
  found->second.unanswered_bytes += bytes;
  return true;
}

void ClientTable::end_call(ClientId id, std::uint64_t call) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end()) return;
  Client& client = found->second;
  const auto ended = client.unanswered.find(call);
  if (ended == client.unanswered.end()) return;
  client.unanswered_bytes -= ended->second;
  client.unanswered.erase(ended);
}

bool ClientTable::is_full(ClientId id) const {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  return found != clients_.end() && found->second.unanswered_bytes > kMostUnansweredBytes;
}

ClientTable::State ClientTable::next(ClientId id, OutFrame& frame) {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  if (found == clients_.end() || found->second.cut) return State::kGone;
  if (auto popped = found->second.outbox.pop()) {
    frame = std::move(*popped);
    return State::kFrame;
  }
  found->second.awake = false;
  return State::kNothing;
}

bool ClientTable::is_cut(ClientId id) const {
  const std::lock_guard lock(mutex_);
  const auto found = clients_.find(id);
  return found == clients_.end() || found->second.cut;
}

std::uint64_t ClientTable::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

std::size_t ClientTable::most_waiting_bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t most = 0;
  for (const auto& [id, client] : clients_) most = std::max(most, client.outbox.bytes());
  return most;
}

std::size_t ClientTable::all_message_bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t sum = 0;
  for (const auto& [id, client] : clients_) sum += client.outbox.message_bytes();
  return sum;
}

}  // namespace asperity::studio

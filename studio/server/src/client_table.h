#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "outbox.h"

namespace asperity::studio {

// The browsers that are connected, their topics and what waits to be sent to each. Thread-safe; no function waits for
// a browser.
class ClientTable {
 public:
  // Called on any thread when a client that had nothing to be sent has something; must only pass it on.
  using Wake = std::function<void()>;

  static constexpr std::size_t kMostTopics = 64;
  static constexpr std::size_t kMostUnanswered = 1000;
  static constexpr std::size_t kMostUnansweredBytes = 4U << 20U;
  // Answers and events that wait for all clients together: beyond them the one for whom most wait is cut off. Frames of
  // topics are shared.
  static constexpr std::size_t kMostMessageBytes = 512U << 20U;

  explicit ClientTable(std::size_t most_clients) : most_clients_(most_clients) {}

  // None if there are too many.
  std::optional<ClientId> join(Wake wake);
  // False if it had left.
  bool leave(ClientId client);

  // Both throw Error for an invalid name of a topic; subscribe for too many of them.
  void subscribe(ClientId client, std::string_view topic);
  void unsubscribe(ClientId client, std::string_view topic);
  bool has_subscribers(std::string_view topic) const;

  void publish(std::string_view topic, std::string frame, Delivery delivery);
  void send_all(std::string text);
  void send(ClientId client, std::string bytes, bool is_text);

  // Counts the calls that a client waits for, and the bytes of their messages. begin_call is false if it would be one
  // too many. An answer to be sent comes after its end_call.
  bool begin_call(ClientId client, std::uint64_t call, std::size_t bytes);
  void end_call(ClientId client, std::uint64_t call);
  // True if so many bytes of calls wait that no more should be read from it.
  bool is_full(ClientId client) const;

  enum class State { kFrame, kNothing, kGone };
  // The next frame for a client. kNothing: it will be woken when there is one. kGone: it has left or is cut.
  State next(ClientId client, OutFrame& frame);
  // True if it has left, or does not take its answers and is to be cut off, which it is woken for.
  bool is_cut(ClientId client) const;

  // Frames of series that were dropped for slow browsers.
  std::uint64_t dropped() const;
  // The most bytes that wait for any client.
  std::size_t most_waiting_bytes() const;
  // Those of answers and events for all of them.
  std::size_t all_message_bytes() const;

 private:
  struct Client {
    Wake wake;
    Outbox outbox;
    std::set<std::string, std::less<>> topics;
    std::multimap<std::uint64_t, std::size_t> unanswered;  // the bytes of each call, by its id
    std::size_t unanswered_bytes = 0;
    bool awake = false;
    bool cut = false;
  };

  static void rouse(Client& client);
  static void push(Client& client, const OutFrame& frame);
  static void cut(Client& client);
  void keep_within_memory();
  void drop_topic(const std::string& topic);

  const std::size_t most_clients_;
  mutable std::mutex mutex_;
  std::map<ClientId, Client> clients_;
  std::map<std::string, std::size_t, std::less<>> subscribers_;
  ClientId last_id_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace asperity::studio

#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/studio/hub.h"

namespace asperity::studio {

// A frame on its way, shared by all to whom it goes.
struct OutFrame {
  std::shared_ptr<const std::string> bytes;
  bool is_text = false;
};

// What one browser has still to be sent, in the order in which it came; bounded however slow the browser is.
class Outbox {
 public:
  static constexpr std::size_t kMostMessages = 10'000;
  static constexpr std::size_t kMostMessageBytes = 64U << 20U;

  // A frame of a topic. A kLatest one replaces one of the same topic that was not sent. Behind
  // kMaxSeriesBytes of series the oldest of them are dropped. Returns how many were.
  std::size_t push_topic(std::string_view topic, OutFrame frame, Delivery delivery);
  // An answer or event. False, and nothing is added, if too many are waiting; one always fits.
  bool push_message(OutFrame frame);
  // The next to be sent.
  std::optional<OutFrame> pop();
  // A topic's frames that were not sent.
  void forget(std::string_view topic);

  // Of answers and events, which no other browser shares.
  std::size_t message_bytes() const { return message_bytes_; }
  std::size_t bytes() const { return message_bytes_ + series_bytes_ + latest_bytes_; }

 private:
  enum class Lane { kMessage, kSeries, kLatest };
  struct Item {
    Lane lane;
    std::string topic;
    OutFrame frame;
  };
  using Place = std::list<Item>::iterator;

  std::size_t& lane_bytes(Lane lane);
  void take_out(Place place);

  std::list<Item> items_;
  std::list<Place> series_;  // those of items_ that are, oldest first
  std::map<std::string, Place, std::less<>> latest_;
  std::size_t messages_ = 0;
  std::size_t message_bytes_ = 0, series_bytes_ = 0, latest_bytes_ = 0;
};

}  // namespace asperity::studio

#include "outbox.h"

#include <iterator>
#include <utility>

namespace asperity::studio {

std::size_t& Outbox::lane_bytes(Lane lane) {
  if (lane == Lane::kMessage) return message_bytes_;
  return lane == Lane::kSeries ? series_bytes_ : latest_bytes_;
}

void Outbox::take_out(Place place) {
  lane_bytes(place->lane) -= place->frame.bytes->size();
  if (place->lane == Lane::kMessage) --messages_;
  if (place->lane == Lane::kLatest) latest_.erase(place->topic);
  items_.erase(place);
}

std::size_t Outbox::push_topic(std::string_view topic, OutFrame frame, Delivery delivery) {
  const std::size_t bytes = frame.bytes->size();
  if (delivery == Delivery::kLatest) {
    latest_bytes_ += bytes;
    if (const auto waiting = latest_.find(topic); waiting != latest_.end()) {
      OutFrame& older = waiting->second->frame;
      latest_bytes_ -= older.bytes->size();
      older = std::move(frame);
      return 0;
    }
    items_.push_back({Lane::kLatest, std::string(topic), std::move(frame)});
    latest_.emplace(topic, std::prev(items_.end()));
    return 0;
  }
  items_.push_back({Lane::kSeries, std::string(topic), std::move(frame)});
  series_.push_back(std::prev(items_.end()));
  series_bytes_ += bytes;
  std::size_t dropped = 0;
  for (; series_bytes_ > kMaxSeriesBytes && series_.size() > 1; ++dropped) {
    take_out(series_.front());
    series_.pop_front();
  }
  return dropped;
}

bool Outbox::push_message(OutFrame frame) {
  const std::size_t bytes = frame.bytes->size();
  if (messages_ > 0 && (messages_ >= kMostMessages || message_bytes_ + bytes > kMostMessageBytes)) return false;
  items_.push_back({Lane::kMessage, {}, std::move(frame)});
  ++messages_;
  message_bytes_ += bytes;
  return true;
}

std::optional<OutFrame> Outbox::pop() {
  if (items_.empty()) return std::nullopt;
  const Place first = items_.begin();
  if (first->lane == Lane::kSeries) series_.pop_front();
  OutFrame frame = first->frame;
  take_out(first);
  return frame;
}

void Outbox::forget(std::string_view topic) {
  for (auto place = series_.begin(); place != series_.end();) {
    if ((*place)->topic != topic) {
      ++place;
      continue;
    }
    take_out(*place);
    place = series_.erase(place);
  }
  if (const auto waiting = latest_.find(topic); waiting != latest_.end()) take_out(waiting->second);
}

}  // namespace asperity::studio

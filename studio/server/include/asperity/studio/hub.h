#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "asperity/studio/block.h"

namespace asperity::studio {

using ClientId = std::uint64_t;

// What happens to a topic's frames that a slow browser has not yet taken.
enum class Delivery {
  kLatest,  // a newer one replaces it: pictures, states
  kSeries,  // kept in order, up to kMaxSeriesBytes a client; then the oldest are dropped. Each has a sequence number in
            // its head, so the browser sees the gap
};
inline constexpr std::size_t kMaxSeriesBytes = 16U << 20U;

// The way to the browsers. Public functions are thread-safe and never wait for a browser.
class Hub {
 public:
  virtual ~Hub() = default;

  // A binary frame to all who have subscribed to `topic`. The head of a kSeries frame has "sequence" from its maker.
  virtual void publish(std::string_view topic, std::string frame, Delivery delivery) = 0;
  // True if anybody would get it: what nobody sees need not be made.
  virtual bool has_subscribers(std::string_view topic) const = 0;
  // {"event":name,"data":…} to all.
  virtual void broadcast(std::string_view event, const Json& data) = 0;
  // The same to one.
  virtual void notify(ClientId client, std::string_view event, const Json& data) = 0;
  // The answer to a call: {"id":…,"result":…}; or a block, whose head gets "id".
  virtual void answer(ClientId client, std::uint64_t id, const Json& result) = 0;
  virtual void answer_block(ClientId client, std::uint64_t id, BlockWriter block) = 0;
  // {"id":…,"error":{"message":…,"hint":…}}.
  virtual void refuse(ClientId client, std::uint64_t id, std::string_view message, std::string_view hint) = 0;
};

}  // namespace asperity::studio

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/studio/message.h"
#include "topic_name.h"

namespace asperity::studio {

namespace {

constexpr std::uint64_t kLargestId = std::uint64_t{1} << 53;  // beyond it the browser's numbers skip
constexpr std::size_t kPointerBytes = 32;

Call decode_call(std::string_view frame) {
  JsonLimits limits;
  limits.bytes = kMaxMessageBytes;
  limits.depth = kMaxMessageDepth;
  limits.values = kMaxMessageValues;
  limits.keys = kMaxMessageKeys;
  Json message = parse_json(frame, "a message", limits);
  if (!message.is_object()) throw Error("a message is not an object: '" + printable(frame) + "'");
  Call call;
  for (const auto& [key, value] : message.items()) {
    if (key == "id") {
      if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kLargestId) {
        throw Error("a message's id is not a whole number from 0 to 2^53: '" + printable(value.dump()) + "'");
      }
      call.id = value.get<std::uint64_t>();
    } else if (key == "call") {
      if (!value.is_string() || !is_topic_name(value.text())) {
        throw Error("a message's call is not a name of a-z, 0-9, _ and dots: '" + printable(value.dump()) + "'");
      }
      call.name = value.get<std::string>();
    } else if (key == "args") {
      if (!value.is_object()) throw Error("a message's args are not an object: '" + printable(value.dump()) + "'");
      call.args = value;
    } else {
      throw Error("a message has the unknown key '" + printable(key) + "'");
    }
  }
  for (const char* key : {"id", "call"}) {
    if (!message.contains(key)) throw Error(fmt::format("a message has no '{}': '{}'", key, printable(frame)));
  }
  return call;
}

Pointer decode_pointer(std::string_view frame) {
  if (frame.size() != kPointerBytes) {
    throw Error(fmt::format("a binary message of {} bytes; a pointer has {}", frame.size(), kPointerBytes));
  }
  if (!frame.starts_with("ASP1")) throw Error("a binary message is not a pointer of this version");
  Pointer pointer;
  std::memcpy(&pointer.sequence, frame.data() + 4, sizeof pointer.sequence);
  std::memcpy(pointer.p_world_m.data(), frame.data() + 8, sizeof pointer.p_world_m);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(pointer.p_world_m.begin(), pointer.p_world_m.end(), finite)) {
    throw Error("a pointer's position is not finite");
  }
  return pointer;
}

}  // namespace

Message decode_message(std::string_view frame, bool is_text) {
  if (frame.size() > kMaxMessageBytes) {
    throw Error(fmt::format("a message of {} bytes, more than {}", frame.size(), kMaxMessageBytes));
  }
  if (is_text) return decode_call(frame);
  return decode_pointer(frame);
}

}  // namespace asperity::studio

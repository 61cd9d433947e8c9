#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/studio/message.h"
#include "topic_name.h"

namespace asperity::studio {

namespace {

constexpr std::uint64_t kLargestId = std::uint64_t{1} << 53;  // beyond it the browser's numbers skip
constexpr std::size_t kPointerBytes = 32;

// Everything that costs more than its length is bounded while it is read: depth, the keys of an object, which an
// ordered object searches one by one, and values, of which each takes more room than its text.
Json parse_bounded(std::string_view text) {
  std::vector<std::set<std::string>> open;
  std::size_t values = 0;
  const auto watch = [&open, &values](int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    const bool opens = event == Event::object_start || event == Event::array_start;
    if (opens && static_cast<std::size_t>(depth) >= kMaxMessageDepth) {
      throw Error(fmt::format("a message is nested more than {} deep", kMaxMessageDepth));
    }
    if ((opens || event == Event::value) && ++values > kMaxMessageValues) {
      throw Error(fmt::format("a message has more than {} values", kMaxMessageValues));
    }
    if (event == Event::object_start) open.emplace_back();
    if (event == Event::object_end) open.pop_back();
    if (event == Event::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (!open.back().insert(key).second) throw Error("a message has the key '" + printable(key) + "' twice");
      if (open.back().size() > kMaxMessageKeys) {
        throw Error(fmt::format("an object of a message has more than {} keys", kMaxMessageKeys));
      }
    }
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), watch);
  } catch (const Json::out_of_range&) {
    throw Error("a message has a number that is not finite");
  } catch (const Json::exception&) {
    throw Error("a message is not JSON: '" + printable(text) + "'");
  }
}

Call decode_call(std::string_view frame) {
  if (!is_utf8(frame)) throw Error("a message is not UTF-8: '" + printable(frame) + "'");
  Json message = parse_bounded(frame);
  if (!message.is_object()) throw Error("a message is no object: '" + printable(frame) + "'");
  Call call;
  for (auto& [key, value] : message.items()) {
    if (key == "id") {
      if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kLargestId) {
        throw Error("a message's id is no whole number from 0 to 2^53: '" + printable(value.dump()) + "'");
      }
      call.id = value.get<std::uint64_t>();
    } else if (key == "call") {
      if (!value.is_string() || !is_topic_name(value.get_ref<const std::string&>())) {
        throw Error("a message's call is no name of a-z, 0-9, _ and dots: '" + printable(value.dump()) + "'");
      }
      call.name = value.get<std::string>();
    } else if (key == "args") {
      if (!value.is_object()) throw Error("a message's args are no object: '" + printable(value.dump()) + "'");
      call.args = std::move(value);
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
  if (!frame.starts_with("ASP1")) throw Error("a binary message is no pointer of this version");
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

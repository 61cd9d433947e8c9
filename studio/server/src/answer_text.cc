#include "answer_text.h"

#include <utility>

namespace asperity::studio {

namespace {

std::string dump_message(const Json& message) { return message.dump_repaired(); }

}  // namespace

std::string answer_text(std::uint64_t id, const Json& result) {
  Json message;
  message["id"] = id;
  message["result"] = result;
  return dump_message(message);
}

std::string refusal_text(std::uint64_t id, std::string_view words, std::string_view hint) {
  Json error;
  error["message"] = words;
  error["hint"] = hint;
  Json message;
  message["id"] = id;
  message["error"] = std::move(error);
  return dump_message(message);
}

std::string event_text(std::string_view event, const Json& data) {
  Json message;
  message["event"] = event;
  message["data"] = data;
  return dump_message(message);
}

}  // namespace asperity::studio

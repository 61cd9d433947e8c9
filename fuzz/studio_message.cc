// A frame of a browser is refused with an Error, or is a call or pointer within its limits. The input's first byte is
// 't' for a text frame.
#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/studio/message.h"
#include "fuzz_input.h"

namespace {

using asperity::Json;
using asperity::must;

std::size_t depth_of(const Json& value) {
  std::size_t deepest = 0;
  if (value.is_array()) {
    for (const Json& inner : value) deepest = std::max(deepest, depth_of(inner));
  } else if (value.is_object()) {
    for (const auto& member : value.items()) deepest = std::max(deepest, depth_of(member.value));
  } else {
    must(!value.is_number() || std::isfinite(value.get<double>()));
    return 0;
  }
  return 1 + deepest;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace studio = asperity::studio;
  if (size == 0) return 0;
  const bool is_text = data[0] == 't';
  try {
    const studio::Message message = studio::decode_message(asperity::fuzz_text(data + 1, size - 1), is_text);
    if (const auto* call = std::get_if<studio::Call>(&message)) {
      must(is_text && call->args.is_object() && call->id <= std::uint64_t{1} << 53);
      must(!call->name.empty() && call->name.size() <= 64);
      must(depth_of(call->args) < studio::kMaxMessageDepth);
      // What was taken is taken again from its own text.
      Json again;
      again["id"] = call->id;
      again["call"] = call->name;
      again["args"] = call->args;
      const auto twice = studio::decode_message(again.dump(), true);
      must(std::get<studio::Call>(twice).args == call->args);
    } else {
      must(!is_text && size == 33);
      for (const double x : std::get<studio::Pointer>(message).p_world_m) must(std::isfinite(x));
    }
  } catch (const asperity::Error&) {  // most inputs
  }
  return 0;
}

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "asperity/studio/block.h"

namespace asperity::studio {

// What a browser may send (docs/studio-protocol.md). Nothing else is taken.

// A text frame {"id":7,"call":"scan.start","args":{…}}: answered once, under its id.
struct Call {
  std::uint64_t id = 0;
  std::string name;
  Json args = Json::object();
};

// A binary frame of 32 bytes: where the pointer that stands for a haptic device pulls the device point, in the scene's
// world. Not answered; only the owner of the force is heard.
//   u32 magic "ASP1", u32 sequence, 3 × f64 metres
struct Pointer {
  std::uint32_t sequence = 0;
  std::array<double, 3> p_world_m{};
};

using Message = std::variant<Call, Pointer>;

inline constexpr std::size_t kMaxMessageBytes = 1U << 20U;
inline constexpr std::size_t kMaxMessageDepth = 32;
inline constexpr std::size_t kMaxMessageKeys = 1000;       // of one object
inline constexpr std::size_t kMaxMessageValues = 200'000;  // of all, arrays and objects among them

// Takes a frame apart. Throws Error saying what is wrong with it: too long, no UTF-8, no JSON, nested too deeply, too
// many keys in an object or values in all, a key twice or unknown or missing (`args` may be), a name that is none
// ([a-z0-9_.]{1,64}), an id beyond 2^53, a number that is not finite.
Message decode_message(std::string_view frame, bool is_text);

}  // namespace asperity::studio

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace asperity {

// Why the safety layer changed a force: flags of ServoTick::limited_by. Passivity and the two
// limits are set on ticks whose force they changed; the others are states of the run, set as long as they last.
enum class SafetyCause : std::uint32_t {
  kFault = 1U << 0U,         // the device reports a fault: zero at once
  kNonFinite = 1U << 1U,     // a position or a force is not a finite number: ramp to zero
  kStale = 1U << 2U,         // no news from the device: ramp to zero
  kEnding = 1U << 3U,        // the run ends: ramp to zero
  kSoftStart = 1U << 4U,     // the force grows from zero
  kPassivity = 1U << 5U,     // damping against created energy
  kForceLimit = 1U << 6U,    // too large: shortened
  kRateLimit = 1U << 7U,     // changed too fast: follows
  kNotPermitted = 1U << 8U,  // nobody has leave to command forces (force_permit.h): ramp to zero
  kImplausible = 1U << 9U,   // no hand can be at the stated position (reflexes.h): ramp to zero
};

inline constexpr std::array<std::string_view, 10> kSafetyCauseNames{
    "fault",     "non-finite",  "stale",      "ending",        "soft-start",
    "passivity", "force-limit", "rate-limit", "not-permitted", "implausible"};

constexpr std::uint32_t flag(SafetyCause cause) noexcept { return static_cast<std::uint32_t>(cause); }

// The names of the flags in `causes` joined by '+', such as "stale+rate-limit"; empty for none.
std::string cause_names(std::uint32_t causes);

}  // namespace asperity

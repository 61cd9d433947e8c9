#include "status.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>

#include "asperity/base/text.h"
#include "asperity/base/version.h"

namespace asperity::c_library {

namespace {

constexpr std::size_t kLongest = 1024;
thread_local std::array<char, kLongest> last_error{};

}  // namespace

void set_last_error(std::string_view text) noexcept {
  std::string safe;
  try {
    safe = printable(text, kLongest);
  } catch (const std::bad_alloc&) {
    safe.clear();  // the status says it
  }
  text = safe;
  std::size_t length = std::min(text.size(), kLongest - 1);
  // Not in the middle of a character.
  if (length < text.size()) {
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  }
  std::memcpy(last_error.data(), text.data(), length);
  last_error[length] = '\0';
}

double within(double value, const Range& range, const char* name) {
  if (!(value >= range.low) || !(value <= range.high)) {
    throw BadArgument(std::string(name) + " is " + number_text(value) + ", not from " + number_text(range.low) +
                      " to " + number_text(range.high));
  }
  return value;
}

}  // namespace asperity::c_library

extern "C" {

const char* asperity_status_text(asperity_status status) {
  switch (status) {
    case ASPERITY_OK:
      return "done";
    case ASPERITY_BAD_ARGUMENT:
      return "wrong argument";
    case ASPERITY_BAD_FILE:
      return "a file or scene that cannot be used";
    case ASPERITY_NO_MEMORY:
      return "not enough memory";
    case ASPERITY_INTERNAL:
      return "a fault of the library";
    case ASPERITY_STATUS_LARGEST:
      break;
  }
  return "unknown status";
}

const char* asperity_last_error(void) { return asperity::c_library::last_error.data(); }

const char* asperity_feel_version(void) {
  static std::array<char, 64> text{};
  static const bool once = [] {
    std::snprintf(text.data(), text.size(), "%d.%d (asperity %s)", ASPERITY_FEEL_MAJOR, ASPERITY_FEEL_MINOR,
                  asperity::kVersion);
    return true;
  }();
  static_cast<void>(once);
  return text.data();
}
}

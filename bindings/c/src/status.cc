#include "status.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "asperity/base/version.h"

namespace asperity::c_library {

namespace {

constexpr std::size_t kLongest = 1024;
thread_local std::array<char, kLongest> last_error{};

}  // namespace

void set_last_error(std::string_view text) noexcept {
  std::size_t length = std::min(text.size(), kLongest - 1);
  // Not in the middle of a character.
  if (length < text.size()) {
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
  }
  std::memcpy(last_error.data(), text.data(), length);
  last_error[length] = '\0';
}

}  // namespace asperity::c_library

extern "C" {

const char* asperity_status_text(asperity_status status) {
  switch (status) {
    case ASPERITY_OK:
      return "done";
    case ASPERITY_BAD_ARGUMENT:
      return "an argument cannot be";
    case ASPERITY_BAD_FILE:
      return "a file or scene cannot be used";
    case ASPERITY_NO_MEMORY:
      return "there is not enough memory";
    case ASPERITY_INTERNAL:
      return "a fault of the library";
  }
  return "no status of this library";
}

const char* asperity_last_error(void) { return asperity::c_library::last_error.data(); }

const char* asperity_feel_version(void) {
  static const std::string text = std::to_string(ASPERITY_FEEL_MAJOR) + "." + std::to_string(ASPERITY_FEEL_MINOR) +
                                  " (asperity " + asperity::kVersion + ")";
  return text.c_str();
}
}

#include "driver_library.h"

#include <dlfcn.h>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kLongestReason = 300;

std::string last_error() {
  const char* const text = dlerror();
  return text == nullptr ? "it cannot be loaded" : printable(text, kLongestReason);
}

}  // namespace

void load_driver(const std::string& device, const std::vector<std::string>& libraries,
                 const std::vector<DriverSymbol>& symbols) {
  std::string reasons;
  for (const std::string& library : libraries) {
    reasons += "\n  " + printable(library, kLongestReason) + ": ";
    void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == nullptr) {
      reasons += last_error();
      continue;
    }
    const char* missing = nullptr;
    for (const DriverSymbol& symbol : symbols) {
      *symbol.address = dlsym(handle, symbol.name);
      if (*symbol.address == nullptr && symbol.required) {
        missing = symbol.name;
        break;
      }
    }
    if (missing == nullptr) return;
    reasons += std::string("it has no function '") + missing + "'";
  }
  throw Error(device + ": its driver was not found; searched for:" + reasons);
}

}  // namespace asperity

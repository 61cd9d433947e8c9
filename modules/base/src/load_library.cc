#include "asperity/base/load_library.h"

#include <dlfcn.h>
#include <system_error>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::size_t kLongestReason = 300;

std::string last_error() {
  const char* const text = dlerror();
  return text == nullptr ? "it cannot be loaded" : printable(text, kLongestReason);
}

std::filesystem::path& chosen_folder() {
  static std::filesystem::path folder;
  return folder;
}

}  // namespace

void load_library(const std::string& what, const std::vector<std::string>& libraries,
                  const std::vector<LibrarySymbol>& symbols) {
  std::string reasons;
  for (const std::string& library : libraries) {
    reasons += "\n  " + printable(library, kLongestReason) + ": ";
    void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == nullptr) {
      reasons += last_error();
      continue;
    }
    const char* missing = nullptr;
    for (const LibrarySymbol& symbol : symbols) {
      *symbol.address = dlsym(handle, symbol.name);
      if (*symbol.address == nullptr && symbol.required) {
        missing = symbol.name;
        break;
      }
    }
    if (missing == nullptr) return;
    reasons += std::string("it has no function '") + missing + "'";
  }
  throw Error(what + " was not found; searched for:" + reasons);
}

std::vector<std::string> own_library_paths(const std::string& name) {
  if (!chosen_folder().empty()) return {(chosen_folder() / name).string()};
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  if (error) throw Error(name + ": the folder of this program is not known: " + error.message());
  return {(folder.parent_path() / "lib" / "asperity" / name).string(), (folder / name).string()};
}

void set_own_library_folder(std::filesystem::path folder) { chosen_folder() = std::move(folder); }

}  // namespace asperity

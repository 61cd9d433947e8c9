#include "put_aside.h"

#include <string>
#include <system_error>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/sync_folder.h"
#include "asperity/studio/project.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr int kMostNames = 10'000;

bool has_content(const fs::path& file, std::string_view content) {
  try {
    return read_file(file, content.size()) == content;
  } catch (const Error&) {
    return false;  // it is larger, or cannot be read
  }
}

// The first name that is free, or whose file is `good`. Throws Error if a name cannot be looked up.
template <class Good>
fs::path name_beside(const fs::path& file, const std::string& ending, const Good& good) {
  for (int i = 1; i <= kMostNames; ++i) {
    fs::path name = file;
    name += i == 1 ? ending : ending + "_" + std::to_string(i);
    if (!is_taken(name) || good(name)) return name;
  }
  throw Error(file.string() + ": all names from " + ending + " to " + ending + "_" + std::to_string(kMostNames) +
              " are taken");
}

}  // namespace

fs::path put_aside(const fs::path& file) {
  fs::path name = name_beside(file, ".unreadable", [](const fs::path&) { return false; });
  std::error_code error;
  fs::rename(file, name, error);
  if (error) throw Error("cannot be renamed to " + name.filename().string() + ": " + error.message());
  try {
    // Or a power cut after the next save could leave the new file and none under the new name.
    sync_folder(file.parent_path());
  } catch (const Error&) {
    fs::rename(name, file, error);
    throw;
  }
  return name;
}

fs::path keep_copy(const fs::path& file, std::string_view content) {
  fs::path name = name_beside(file, ".before", [&](const fs::path& taken) { return has_content(taken, content); });
  if (!has_content(name, content)) write_file(name, content);
  return name;
}

}  // namespace asperity::studio

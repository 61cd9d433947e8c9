#include "file_holders.h"

#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "asperity/base/text.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr int kMostHolders = 3;

bool has_open(const fs::path& process, const fs::path& file) {
  std::error_code error;
  for (fs::directory_iterator it(process / "fd", error), end; !error && it != end; it.increment(error)) {
    std::error_code unreadable;
    if (fs::read_symlink(it->path(), unreadable) == file && !unreadable) return true;
  }
  return false;
}

}  // namespace

std::string file_holders(const std::string& path) {
  std::error_code error;
  const fs::path file = fs::canonical(path, error);
  if (error) return {};
  std::string out;
  int named = 0;
  for (fs::directory_iterator it("/proc", error), end; !error && it != end && named < kMostHolders;
       it.increment(error)) {
    const std::string id = it->path().filename().string();
    if (!std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) continue;
    if (!has_open(it->path(), file)) continue;
    std::string name;
    std::getline(std::ifstream(it->path() / "comm"), name);
    out += (named++ == 0 ? "process " : ", ") + id + " (" + printable(name) + ")";
  }
  return out;
}

}  // namespace asperity

#include "asperity/base/inner_path.h"

#include <new>
#include <system_error>

#include "asperity/base/error.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// With links followed; none if that leads nowhere: a loop, a name too long, a folder that may not be read.
std::optional<fs::path> followed(const fs::path& path) {
  std::error_code error;
  fs::path out = fs::weakly_canonical(path, error);
  if (error == std::errc::not_enough_memory) throw std::bad_alloc();
  if (error == std::errc::io_error) throw Error(path.string() + ": cannot be read: " + error.message());
  if (error) return std::nullopt;
  return out;
}

}  // namespace

std::optional<fs::path> inner_file(const fs::path& folder, std::string_view written) {
  const std::optional<std::string> inner = inner_path(written);
  if (!inner) return std::nullopt;
  const std::optional<fs::path> root = followed(folder.empty() ? "." : folder);
  if (!root) return std::nullopt;
  std::optional<fs::path> file = followed(*root / *inner);
  if (!file) return std::nullopt;
  const fs::path relative = file->lexically_relative(*root);
  if (relative.empty() || *relative.begin() == "..") return std::nullopt;
  return file;
}

}  // namespace asperity

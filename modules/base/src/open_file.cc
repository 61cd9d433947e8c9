#include "open_file.h"

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "asperity/base/error.h"

namespace asperity {

OpenFile open_file(const std::filesystem::path& path, std::uint64_t limit_bytes) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) throw Error(path.string() + ": no such file");
  if (error) throw Error(path.string() + ": cannot be looked up: " + error.message());
  if (!std::filesystem::is_regular_file(status)) throw Error(path.string() + ": not a regular file");
  OpenFile out;
  out.bytes = std::filesystem::file_size(path, error);
  if (error) throw Error(path.string() + ": " + error.message());
  if (out.bytes > limit_bytes) {
    throw Error(path.string() + ": " + std::to_string(out.bytes) + " bytes, more than the limit of " +
                std::to_string(limit_bytes));
  }
  out.stream.open(path, std::ios::binary);
  if (!out.stream) throw Error(path.string() + ": cannot be opened: " + std::strerror(errno));
  return out;
}

void check_read(const std::ifstream& stream, const std::filesystem::path& path) {
  if (stream.bad()) throw Error(path.string() + ": cannot be read: " + std::strerror(errno));
}

}  // namespace asperity

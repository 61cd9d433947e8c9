#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "asperity/base/error.h"

namespace asperity::studio {

// A folder of its own among the system's temporary ones, gone with all that is in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "asperity-scan-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw Error(name + ": a temporary folder cannot be made");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace asperity::studio

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/studio/project.h"
#include "temporary_folder.h"

namespace asperity::studio {

// A file that a browser is about to send: its path below the folder that was dropped, with /, and its size.
struct AddedFile {
  std::string path;
  std::uint64_t bytes = 0;
};

// What one addition may bring.
inline constexpr std::size_t kMostAddedFiles = 2000;
inline constexpr std::uint64_t kMostAddedBytes = std::uint64_t{8} << 30U;
inline constexpr std::size_t kMostAdditions = 8;  // that are under way, of all windows
inline constexpr std::size_t kDeepestAdded = 8;   // parts of a path

// Throws Advice naming the path and what is wrong with it: not relative, with `..`, hidden, with a control character,
// not UTF-8, a part over 255 bytes, too deep, there twice (letters of either case are the same, as other systems have
// it), or a file where another path needs a folder; and if there are none, too many, or too many bytes.
void check_added_files(const std::vector<AddedFile>& files);

// Files that a browser adds to the project. Their bytes are taken one file after another into a hidden folder of the
// project; commit() puts them in their places, and without it nothing remains. Nothing that is there is replaced: what
// has a name that is taken gets a free one. For one thread at a time.
class Addition {
 public:
  // Throws Advice as check_added_files does, and if the disk has not that much room.
  Addition(const Project& project, std::vector<AddedFile> files);

  // The next bytes of a file. Throws Error if they are not the next, more than was announced, or cannot be written.
  void append(std::size_t file, std::uint64_t at, std::string_view bytes);

  // What was put in place, by its name in the project's folder; `from` is the name that it had.
  struct Placed {
    std::string from, name;
  };
  // Throws Error if a file is not whole; then nothing was put in place.
  std::vector<Placed> commit();

 private:
  void begin_files();

  const Project project_;
  TemporaryFolder folder_;
  std::vector<AddedFile> files_;
  std::size_t current_ = 0;  // the file that is being taken; those before are whole
  std::uint64_t taken_ = 0;  // its bytes
};

}  // namespace asperity::studio

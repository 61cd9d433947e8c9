#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace asperity::cli {

// A call that power_shim.c has noted.
struct DiskCall {
  std::string kind;  // new, write, size, sync, name, swap, gone, folder
  std::string file;  // device:inode
  std::string path, to;
  std::uint64_t at = 0;  // offset, or the new size
  std::string bytes;
};

// Throws std::runtime_error for a log that is not one.
std::vector<DiskCall> read_disk_log(const std::filesystem::path& log);

// Every file by its path below the root, with its content; folders end with a slash.
using Tree = std::map<std::string, std::string>;

// What is on a disk if the power goes between two calls. Certain is what was forced to it: a file's bytes and size by a
// sync of the file, a name (new, renamed, gone) by a sync of every folder that has or had it. Of all else any part may
// be there, in any order: more than file systems do, so that nothing rests on what one of them happens to do.
class PowerCut {
 public:
  // `before`: what was below `root` when the calls began, all of it on the disk. Throws for calls that do not fit it.
  PowerCut(const std::vector<DiskCall>& calls, const std::filesystem::path& root, const Tree& before);

  std::size_t calls() const { return changes_.size(); }
  // What kind of thing a call changes that is not certain yet.
  enum class Part { kBytes, kNames };
  // After the first `count` calls; of what is not certain that which `is_there` says, asked in the order of the calls.
  Tree after(std::size_t count, const std::function<bool(Part, std::size_t call)>& is_there) const;

 private:
  struct Name {
    int folder = 0;
    std::string name;
    int node = -1;  // none: gone
  };
  struct Change {
    enum class Kind { kWrite, kSize, kNames, kSync } kind = Kind::kSync;
    int node = -1;
    std::uint64_t at = 0;
    std::string bytes;
    std::vector<Name> names;
    std::size_t certain_after = 0;  // the number of calls from which on it is certain
  };
  struct Node {
    bool is_folder = false;
    std::string bytes;
    std::map<std::string, int> names;
  };

  int node_at(const std::string& path) const;
  Name place_of(const std::string& path) const;
  void bind(const Name& name);
  void take(const DiskCall& call);
  void find_when_certain();
  void list(const std::vector<Node>& nodes, int folder, const std::string& prefix, Tree& out) const;

  std::string root_;
  std::vector<Node> first_;           // before the calls; later ones are added empty
  std::vector<Node> now_;             // while the calls are taken
  std::map<std::string, int> files_;  // by device:inode
  std::vector<Change> changes_;       // one a call
};

}  // namespace asperity::cli

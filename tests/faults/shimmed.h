#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "run_asperity.h"

namespace asperity::cli {

// The number that an environment variable states, or `otherwise`.
long number_from(const char* variable, long otherwise);

// What a program under the shim has done: calls on files below the root, and allocations.
struct Calls {
  long io = 0, memory = 0;
};

// The variables of this process, which a program inherits, while it runs.
class Variables {
 public:
  explicit Variables(std::map<std::string, std::string> all);
  ~Variables();
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;

 private:
  std::map<std::string, std::string> all_;
};

// The program under the shim (fault_shim.c), with calls below `root`/work counted, and those failing that the settings
// name.
class Shimmed {
 public:
  explicit Shimmed(const std::filesystem::path& root);

  Outcome run_with(const std::vector<std::string>& words, const std::map<std::string, std::string>& settings);
  Calls calls() const;  // of the last run

 private:
  std::filesystem::path root_, counts_;
};

}  // namespace asperity::cli

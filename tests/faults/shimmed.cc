#include "shimmed.h"

#include <cstdlib>
#include <fstream>
#include <utility>

namespace asperity::cli {

long number_from(const char* variable, long otherwise) {
  const char* text = ::getenv(variable);
  return text == nullptr ? otherwise : std::atol(text);
}

Variables::Variables(std::map<std::string, std::string> all) : all_(std::move(all)) {
  for (const auto& [name, value] : all_) ::setenv(name.c_str(), value.c_str(), 1);
}

Variables::~Variables() {
  for (const auto& [name, value] : all_) ::unsetenv(name.c_str());
}

Shimmed::Shimmed(const std::filesystem::path& root)
    : root_(std::filesystem::canonical(root)), counts_(root / "counts") {}

Outcome Shimmed::run_with(const std::vector<std::string>& words, const std::map<std::string, std::string>& settings) {
  std::map<std::string, std::string> all = settings;
  all["LD_PRELOAD"] = FAULT_SHIM;
  all.emplace("FAULT_ROOT", (root_ / "work").string());
  all["FAULT_COUNTS"] = counts_.string();
  const Variables variables(std::move(all));
  return run(words);
}

Calls Shimmed::calls() const {
  Calls out;
  std::ifstream(counts_) >> out.io >> out.memory;
  return out;
}

}  // namespace asperity::cli

#include "asperity/pipeline/process_methods.h"

namespace asperity {

std::string describe_methods() {
  std::string out;
  for (std::size_t i = 0; i < ProcessMethods::kNames.size(); ++i) {
    const char* const between = i == 0 ? "" : i + 1 < ProcessMethods::kNames.size() ? ", " : " or ";
    out.append(between).append(ProcessMethods::kNames[i]).append(" (").append(ProcessMethods::kTitles[i]).append(")");
  }
  return out;
}

}  // namespace asperity

#include "asperity/device/safety_cause.h"

namespace asperity {

std::string cause_names(std::uint32_t causes) {
  std::string names;
  for (std::size_t k = 0; k < kSafetyCauseNames.size(); ++k) {
    if ((causes >> k & 1U) == 0) continue;
    if (!names.empty()) names += '+';
    names += kSafetyCauseNames[k];
  }
  return names;
}

}  // namespace asperity

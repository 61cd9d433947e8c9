#include "asperity/pipeline/placement.h"

#include <map>

namespace asperity {

std::vector<std::vector<std::size_t>> group_placements(const std::vector<std::size_t>& stated) {
  std::vector<std::vector<std::size_t>> out;
  std::map<std::size_t, std::size_t> known;
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const auto [at, is_new] = known.try_emplace(stated[i], out.size());
    if (is_new) out.emplace_back();
    out[at->second].push_back(i);
  }
  return out;
}

}  // namespace asperity

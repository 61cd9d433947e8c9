#pragma once

#include <string>
#include <vector>

#include "asperity/pipeline/register_scans.h"

namespace asperity {

// The scans' names, in their order.
inline std::vector<std::string> names_of(const ScansOnMesh& result) {
  std::vector<std::string> out;
  for (const RegisteredScan& scan : result.scans) out.push_back(scan.name);
  return out;
}

}  // namespace asperity

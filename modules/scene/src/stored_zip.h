#pragma once

#include <string>
#include <vector>

namespace asperity {

struct ZipMember {
  std::string name;
  std::string content;
};

// A zip archive whose members are stored as they are, dated 1 January 1980: the same members give the same bytes.
// Throws Error for 4 GiB or more.
std::string format_stored_zip(const std::vector<ZipMember>& members);

}  // namespace asperity

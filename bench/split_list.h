#pragma once

#include <string>
#include <string_view>
#include <vector>

// What stands between the commas of an option's value.
inline std::vector<std::string> split_list(std::string_view list) {
  std::vector<std::string> out;
  while (true) {
    const auto comma = list.find(',');
    out.emplace_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return out;
    list.remove_prefix(comma + 1);
  }
}

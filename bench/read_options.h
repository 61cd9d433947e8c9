#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace bench {

// What to do with an option's value.
using Action = std::function<void(std::string_view value)>;
using Options = std::map<std::string_view, Action>;  // by the option's name

// Takes "--name value" pairs. Throws asperity::Error if a value is missing or an option unknown.
inline void read_options(int argc, char** argv, const Options& options) {
  for (int i = 1; i < argc; i += 2) {
    const std::string name = argv[i];
    const auto option = options.find(name);
    if (option == options.end()) throw asperity::Error("unknown option " + name);
    if (i + 1 >= argc) throw asperity::Error(name + ": a value is missing");
    try {
      option->second(argv[i + 1]);
    } catch (const asperity::Error& error) {
      throw asperity::Error(name + ": " + error.what());
    }
  }
}

inline double number_within(std::string_view text, double low, double high) {
  const auto value = asperity::parse_double(text);
  if (!value || !(*value >= low && *value <= high)) {
    throw asperity::Error("'" + std::string(text) + "' is not from " + asperity::number_text(low) + " to " +
                          asperity::number_text(high));
  }
  return *value;
}

inline int seed_count(std::string_view text) { return static_cast<int>(number_within(text, 1.0, 1000.0)); }

// What stands between the commas.
inline std::vector<std::string> split_list(std::string_view list) {
  std::vector<std::string> out;
  while (true) {
    const auto comma = list.find(',');
    out.emplace_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return out;
    list.remove_prefix(comma + 1);
  }
}

// True for `yes`, false for `no`.
inline bool is_first(std::string_view value, std::string_view yes, std::string_view no) {
  if (value == yes || value == no) return value == yes;
  throw asperity::Error("'" + std::string(value) + "' is not " + std::string(yes) + " or " + std::string(no));
}

// Actions that put the value into `out`; they throw asperity::Error where it is not one of these.
template <class Whole>
Action whole_into(Whole& out, double low, double high) {
  return [&out, low, high](std::string_view value) { out = static_cast<Whole>(number_within(value, low, high)); };
}

inline Action number_into(double& out, double low, double high) {
  return [&out, low, high](std::string_view value) { out = number_within(value, low, high); };
}

inline Action yes_into(bool& out) {
  return [&out](std::string_view value) { out = is_first(value, "yes", "no"); };
}

inline Action list_into(std::vector<std::string>& out) {
  return [&out](std::string_view value) { out = split_list(value); };
}

inline Action text_into(std::string& out) {
  return [&out](std::string_view value) { out = value; };
}

}  // namespace bench

#include "config_file.h"

#include <toml++/toml.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/base/unknown_setting.h"
#include "asperity/json/config_json.h"

namespace asperity::app {

namespace {

constexpr std::uint64_t kLargestFile_bytes = 1 << 20;

[[noreturn]] void fail(const std::string& file, const toml::source_region& where, std::string_view message) {
  throw Error(file + ":" + std::to_string(where.begin.line) + ": " + std::string(message));
}

ConfigValue value_of(const std::string& file, const toml::node& node) {
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* list = node.as_array()) {
    std::vector<double> out;
    for (const toml::node& element : *list) {
      const auto number = element.value<double>();
      if (!number) fail(file, element.source(), "lists may hold numbers only");
      out.push_back(*number);
    }
    return out;
  }
  fail(file, node.source(), "dates and times are not allowed");
}

void set_table(const std::string& file, const toml::table& table, const std::string& prefix,
               const std::vector<ConfigField>& fields) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      set_table(file, *inner, path + ".", fields);
      continue;
    }
    const ConfigValue value = value_of(file, node);
    try {
      find_field(fields, path).set(value);
    } catch (const Error& error) {
      fail(file, node.source(), setting_fault(error));
    }
  }
}

}  // namespace

void load_config_file(const std::filesystem::path& path, const std::vector<ConfigField>& fields) {
  const std::string text = read_file(path, kLargestFile_bytes);
  const std::string file = path.string();
  try {
    set_table(file, toml::parse(text, file), "", fields);
  } catch (const toml::parse_error& error) {
    fail(file, error.source(), error.description());
  }
}

std::string setting_fault(const Error& error) {
  const auto* unknown = dynamic_cast<const UnknownSetting*>(&error);
  return std::string(error.what()) +
         (unknown != nullptr && !unknown->names_nearest() ? "; --print-config lists them all" : "");
}

std::string fields_to_json(const std::vector<ConfigField>& fields) { return config_json(fields).dump(2); }

}  // namespace asperity::app

#include "config_file.h"

#include <toml++/toml.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/config_json.h"

namespace asperity::app {

namespace {

constexpr std::uint64_t kLargestFile_bytes = 1 << 20;

[[noreturn]] void fail(const std::string& file, const toml::source_region& where, std::string_view message) {
  throw Error(file + ":" + std::to_string(where.begin.line) + ": " + std::string(message));
}

// `node` in the notation that ConfigField::set takes: strings quoted, so that a number field refuses "5".
std::string field_text(const std::string& file, const toml::node& node) {
  if (const auto* text = node.as_string()) return '"' + text->get() + '"';
  if (const auto* integer = node.as_integer()) return std::to_string(integer->get());
  if (const auto* number = node.as_floating_point()) {
    // A field of whole numbers must see that 5.0 is none.
    const std::string digits = number_text(number->get());
    return digits.find_first_of(".en") == std::string::npos ? digits + ".0" : digits;
  }
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* list = node.as_array()) {
    std::string out = "[";
    for (const toml::node& element : *list) {
      if (element.is_array()) fail(file, element.source(), "lists inside lists are not used here");
      out += (out.size() > 1 ? ", " : "") + field_text(file, element);
    }
    return out + "]";
  }
  fail(file, node.source(), "dates and times are not used here");
}

void set_table(const std::string& file, const toml::table& table, const std::string& prefix,
               const std::vector<ConfigField>& fields) {
  for (const auto& [key, node] : table) {
    const std::string path = prefix + std::string(key.str());
    if (const auto* inner = node.as_table()) {
      set_table(file, *inner, path + ".", fields);
      continue;
    }
    const std::string text = field_text(file, node);
    try {
      set_field(fields, path, text);
    } catch (const Error& error) {
      fail(file, node.source(), error.what());
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

std::string fields_to_json(const std::vector<ConfigField>& fields) { return config_json(fields); }

}  // namespace asperity::app

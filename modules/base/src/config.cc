#include "asperity/base/config.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/nearest_word.h"
#include "asperity/base/text.h"
#include "asperity/base/unknown_setting.h"

namespace asperity {

namespace {

[[noreturn]] void refuse(const std::string& path, std::string_view text, const std::string& wanted) {
  throw Error(path + ": '" + printable(text) + "' is not " + wanted);
}

std::string range_text(const Range& range) {
  const bool low = std::isfinite(range.low);
  const bool high = std::isfinite(range.high);
  if (low && high) return " from " + number_text(range.low) + " to " + number_text(range.high);
  if (low) return " of at least " + number_text(range.low);
  if (high) return " of at most " + number_text(range.high);
  return "";
}

bool is_in(const Range& range, double value) {
  return std::isfinite(value) && value >= range.low && value <= range.high;
}

// What the field takes, for a message.
std::string allowed_text(const ConfigField& field) {
  switch (field.type) {
    case FieldType::kBool:
      return "true or false";
    case FieldType::kInteger:
      return "a whole number" + range_text(field.range);
    case FieldType::kNumber:
      return "a number" + range_text(field.range);
    case FieldType::kText:
      return "UTF-8 text";
    case FieldType::kNumbers:
      return "a list of " + std::to_string(std::get<std::vector<double>>(field.get()).size()) + " numbers" +
             range_text(field.range);
    case FieldType::kChoice:
      break;
  }
  std::string all;
  for (const auto& one : field.choices) all += (all.empty() ? "" : ", ") + one;
  return "one of " + all;
}

std::optional<double> number_of(const ConfigValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  return std::nullopt;
}

std::string toml_number(double value) {
  std::string text = number_text(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

// A basic string of TOML, which is one of JSON too.
std::string toml_string(std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      out += "\\u00";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string_view unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') return text.substr(1, text.size() - 2);
  return text;
}

// A text as it is, anything else as TOML writes it.
std::string plain_text(const ConfigValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : toml_text(value);
}

// In a message a text stands in quotes, so that "5" is seen to be no number.
std::string message_text(const ConfigValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? '"' + *text + '"' : toml_text(value);
}

// What `text` is for a field of that type; nullopt for what it cannot be.
std::optional<ConfigValue> parse_value(FieldType type, std::string_view text) {
  switch (type) {
    case FieldType::kBool:
      if (text != "true" && text != "false") return std::nullopt;
      return text == "true";
    case FieldType::kInteger:
      return parse_int64(text);
    case FieldType::kNumber:
      return parse_double(text);
    case FieldType::kText:
    case FieldType::kChoice:
      return std::string(unquoted(text));
    case FieldType::kNumbers:
      break;
  }
  std::string_view rest = trim(text);
  if (rest.size() >= 2 && rest.front() == '[' && rest.back() == ']') rest = rest.substr(1, rest.size() - 2);
  std::vector<double> numbers;
  while (true) {
    const auto comma = rest.find(',');
    const auto number = parse_double(rest.substr(0, comma));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    if (comma == std::string_view::npos) return numbers;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace

ConfigField& ConfigLister::add(std::string_view name, FieldType type, std::string_view description, Range range) {
  ConfigField& field = fields_.emplace_back();
  field.path = prefix_ + std::string(name);
  field.type = type;
  field.description = description;
  field.range = range;
  return field;
}

void ConfigLister::former(std::string_view name) { fields_.back().former.push_back(prefix_ + std::string(name)); }

void ConfigLister::field(std::string_view name, bool& value, std::string_view description) {
  ConfigField& field = add(name, FieldType::kBool, description, {});
  field.read = [&value] { return ConfigValue(value); };
  field.write = [&value](const ConfigValue& wanted) {
    const auto* flag = std::get_if<bool>(&wanted);
    if (flag != nullptr) value = *flag;
    return flag != nullptr;
  };
}

template <class Integer>
void ConfigLister::add_integer(std::string_view name, Integer& value, std::string_view description, Range range) {
  ConfigField& field = add(name, FieldType::kInteger, description, range);
  field.read = [&value] { return ConfigValue(std::int64_t{value}); };
  field.write = [&value, range](const ConfigValue& wanted) {
    const auto* integer = std::get_if<std::int64_t>(&wanted);
    if (integer == nullptr || !std::in_range<Integer>(*integer)) return false;
    if (!is_in(range, static_cast<double>(*integer))) return false;
    value = static_cast<Integer>(*integer);
    return true;
  };
}

void ConfigLister::field(std::string_view name, int& value, std::string_view description, Range range) {
  add_integer(name, value, description, range);
}

void ConfigLister::field(std::string_view name, std::int64_t& value, std::string_view description, Range range) {
  add_integer(name, value, description, range);
}

void ConfigLister::field(std::string_view name, double& value, std::string_view description, Range range) {
  ConfigField& field = add(name, FieldType::kNumber, description, range);
  field.read = [&value] { return ConfigValue(value); };
  field.write = [&value, range](const ConfigValue& wanted) {
    const auto number = number_of(wanted);
    if (!number || !is_in(range, *number)) return false;
    value = *number;
    return true;
  };
}

void ConfigLister::field(std::string_view name, std::string& value, std::string_view description) {
  ConfigField& field = add(name, FieldType::kText, description, {});
  field.read = [&value] { return ConfigValue(value); };
  field.write = [&value](const ConfigValue& wanted) {
    std::string text = plain_text(wanted);
    if (!is_utf8(text)) return false;
    value = std::move(text);
    return true;
  };
}

void ConfigLister::numbers(std::string_view name, double* values, std::size_t count, std::string_view description,
                           Range range) {
  ConfigField& field = add(name, FieldType::kNumbers, description, range);
  field.read = [values, count] { return ConfigValue(std::vector<double>(values, values + count)); };
  field.write = [values, count, range](const ConfigValue& wanted) {
    const auto* list = std::get_if<std::vector<double>>(&wanted);
    if (list == nullptr || list->size() != count) return false;
    if (!std::all_of(list->begin(), list->end(), [&](double each) { return is_in(range, each); })) return false;
    std::copy(list->begin(), list->end(), values);
    return true;
  };
}

void ConfigLister::add_choice(std::string_view name, std::vector<std::string> names, std::string_view description,
                              std::function<std::size_t()> get, std::function<void(std::size_t)> set) {
  ConfigField& field = add(name, FieldType::kChoice, description, {});
  field.choices = names;
  field.read = [names, get = std::move(get)] { return ConfigValue(names[get()]); };
  field.write = [names = std::move(names), set = std::move(set)](const ConfigValue& wanted) {
    const auto found = std::find(names.begin(), names.end(), plain_text(wanted));
    if (found == names.end()) return false;
    set(static_cast<std::size_t>(found - names.begin()));
    return true;
  };
}

void ConfigField::set(const ConfigValue& value) const {
  if (!write(value)) refuse(path, message_text(value), allowed_text(*this));
}

void ConfigField::set_text(std::string_view text) const {
  const std::optional<ConfigValue> value = parse_value(type, text);
  if (!value || !write(*value)) refuse(path, text, allowed_text(*this));
}

std::string toml_text(const ConfigValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return std::to_string(*integer);
  if (const auto* number = std::get_if<double>(&value)) return toml_number(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_string(*text);
  std::string out = "[";
  for (const double each : std::get<std::vector<double>>(value)) {
    out += (out.size() > 1 ? ", " : "") + toml_number(each);
  }
  return out + "]";
}

const ConfigField& find_field(const std::vector<ConfigField>& fields, std::string_view path) {
  std::vector<std::string> known;
  for (const auto& field : fields) {
    if (field.path == path) return field;
    known.push_back(field.path);
  }
  for (const auto& field : fields) {
    if (std::find(field.former.begin(), field.former.end(), path) != field.former.end()) return field;
  }
  std::string message = "unknown setting '" + printable(path) + "'";
  constexpr std::size_t kMost = 4;  // letters: names are long
  const std::string nearest = nearest_word(path, known, kMost);
  message += nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
  throw UnknownSetting(message, !nearest.empty());
}

void set_field(const std::vector<ConfigField>& fields, std::string_view path, std::string_view text) {
  find_field(fields, path).set_text(text);
}

std::string to_toml(const std::vector<ConfigField>& fields, bool with_descriptions) {
  // TOML wants a table's own keys before its sub-tables; grouping by prefix keeps first-seen order.
  std::vector<std::string> tables;
  const auto table_of = [](const std::string& path) {
    const auto dot = path.rfind('.');
    return dot == std::string::npos ? std::string() : path.substr(0, dot);
  };
  for (const auto& field : fields) {
    const std::string table = table_of(field.path);
    if (std::find(tables.begin(), tables.end(), table) == tables.end()) tables.push_back(table);
  }
  std::stable_partition(tables.begin(), tables.end(), [](const std::string& t) { return t.empty(); });
  std::string out;
  for (const auto& table : tables) {
    if (!out.empty()) out += '\n';
    if (!table.empty()) out += "[" + table + "]\n";
    for (const auto& field : fields) {
      if (table_of(field.path) != table) continue;
      if (with_descriptions && !field.description.empty()) out += "# " + field.description + "\n";
      out += field.path.substr(table.empty() ? 0 : table.size() + 1) + " = " + toml_text(field.get()) + "\n";
    }
  }
  return out;
}

}  // namespace asperity

#include "asperity/base/config.h"

#include <algorithm>
#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

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

double checked_number(const std::string& path, std::string_view text, const Range& range) {
  const auto value = parse_double(text);
  if (!value || !std::isfinite(*value) || *value < range.low || *value > range.high) {
    refuse(path, text, "a number" + range_text(range));
  }
  return *value;
}

template <class Integer>
Integer checked_integer(const std::string& path, std::string_view text, const Range& range) {
  const auto value = parse_int64(text);
  const bool fits = value && std::in_range<Integer>(*value) && static_cast<double>(*value) >= range.low &&
                    static_cast<double>(*value) <= range.high;
  if (!fits) refuse(path, text, "a whole number" + range_text(range));
  return static_cast<Integer>(*value);
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

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row[b.size()];
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

void ConfigLister::field(std::string_view name, bool& value, std::string_view description) {
  ConfigField& field = add(name, FieldType::kBool, description, {});
  field.get = [&value] { return std::string(value ? "true" : "false"); };
  field.set = [&value, path = field.path](std::string_view text) {
    if (text != "true" && text != "false") refuse(path, text, "true or false");
    value = text == "true";
  };
}

void ConfigLister::field(std::string_view name, int& value, std::string_view description, Range range) {
  ConfigField& field = add(name, FieldType::kInteger, description, range);
  field.get = [&value] { return std::to_string(value); };
  field.set = [&value, path = field.path, range](std::string_view text) {
    value = checked_integer<int>(path, text, range);
  };
}

void ConfigLister::field(std::string_view name, std::int64_t& value, std::string_view description, Range range) {
  ConfigField& field = add(name, FieldType::kInteger, description, range);
  field.get = [&value] { return std::to_string(value); };
  field.set = [&value, path = field.path, range](std::string_view text) {
    value = checked_integer<std::int64_t>(path, text, range);
  };
}

void ConfigLister::field(std::string_view name, double& value, std::string_view description, Range range) {
  ConfigField& field = add(name, FieldType::kNumber, description, range);
  field.get = [&value] { return toml_number(value); };
  field.set = [&value, path = field.path, range](std::string_view text) { value = checked_number(path, text, range); };
}

void ConfigLister::field(std::string_view name, std::string& value, std::string_view description) {
  ConfigField& field = add(name, FieldType::kText, description, {});
  field.get = [&value] { return toml_string(value); };
  field.set = [&value, path = field.path](std::string_view text) {
    if (!is_utf8(text)) refuse(path, text, "UTF-8 text");
    value = unquoted(text);
  };
}

void ConfigLister::numbers(std::string_view name, double* values, std::size_t count, std::string_view description,
                           Range range) {
  ConfigField& field = add(name, FieldType::kNumbers, description, range);
  field.get = [values, count] {
    std::string out = "[";
    for (std::size_t i = 0; i < count; ++i) out += (i ? ", " : "") + toml_number(values[i]);
    return out + "]";
  };
  field.set = [values, count, path = field.path, range](std::string_view text) {
    std::string_view rest = trim(text);
    if (rest.size() >= 2 && rest.front() == '[' && rest.back() == ']') rest = rest.substr(1, rest.size() - 2);
    std::vector<double> parsed;
    while (true) {
      const auto comma = rest.find(',');
      parsed.push_back(checked_number(path, rest.substr(0, comma), range));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (parsed.size() != count) refuse(path, text, "a list of " + std::to_string(count) + " numbers");
    std::copy(parsed.begin(), parsed.end(), values);
  };
}

void ConfigLister::add_choice(std::string_view name, std::vector<std::string> names, std::string_view description,
                              std::function<std::size_t()> get, std::function<void(std::size_t)> set) {
  ConfigField& field = add(name, FieldType::kChoice, description, {});
  field.choices = names;
  field.get = [names, get = std::move(get)] { return toml_string(names[get()]); };
  field.set = [names = std::move(names), set = std::move(set), path = field.path](std::string_view text) {
    const auto found = std::find(names.begin(), names.end(), unquoted(text));
    if (found == names.end()) {
      std::string all;
      for (const auto& one : names) all += (all.empty() ? "" : ", ") + one;
      refuse(path, text, "one of " + all);
    }
    set(static_cast<std::size_t>(found - names.begin()));
  };
}

void set_field(const std::vector<ConfigField>& fields, std::string_view path, std::string_view value) {
  const ConfigField* nearest = nullptr;
  std::size_t nearest_distance = std::numeric_limits<std::size_t>::max();
  for (const auto& field : fields) {
    if (field.path == path) {
      field.set(value);
      return;
    }
    const std::size_t distance = edit_distance(path.substr(0, 200), field.path);
    if (distance < nearest_distance) nearest_distance = distance, nearest = &field;
  }
  std::string message = "unknown setting '" + printable(path) + "'";
  if (nearest != nullptr) message += "; did you mean '" + nearest->path + "'?";
  throw Error(message);
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
      out += field.path.substr(table.empty() ? 0 : table.size() + 1) + " = " + field.get() + "\n";
    }
  }
  return out;
}

}  // namespace asperity

#include "asperity/import/column_map.h"

#include <algorithm>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "header_names.h"

namespace asperity {

namespace {

struct MeaningWords {
  std::string_view names;  // with blanks between
  ColumnGroup group;
  Quantity quantity;
};

constexpr MeaningWords kMeanings[] = {
    {"t t2", ColumnGroup::kTime, Quantity::kTime},
    {"px py pz", ColumnGroup::kPosition, Quantity::kLength},
    {"qw qx qy qz", ColumnGroup::kRotation, Quantity::kNumber},
    {"rx ry rz", ColumnGroup::kRotation, Quantity::kAngle},
    {"vx vy vz", ColumnGroup::kRotation, Quantity::kAngle},
    {"m11 m12 m13 m21 m22 m23 m31 m32 m33", ColumnGroup::kRotation, Quantity::kNumber},
    {"ax ay az", ColumnGroup::kAcceleration, Quantity::kAcceleration},
    {"gx gy gz", ColumnGroup::kRate, Quantity::kRate},
    {"f fx fy fz", ColumnGroup::kForce, Quantity::kForce},
};

std::vector<std::string> words_of(std::string_view names) {
  std::vector<std::string> out;
  while (!names.empty()) {
    const std::size_t end = std::min(names.find(' '), names.size());
    out.emplace_back(names.substr(0, end));
    names.remove_prefix(std::min(end + 1, names.size()));
  }
  return out;
}

const MeaningWords& meaning_words(std::string_view meaning) {
  for (const MeaningWords& words : kMeanings) {
    const auto names = words_of(words.names);
    if (std::find(names.begin(), names.end(), meaning) != names.end()) return words;
  }
  throw Error(
      fmt::format("'{}' is not a meaning of a column: t, t2, px py pz, qw qx qy qz, rx ry rz, vx vy vz, m11 … m33, ax "
                  "ay az, gx gy gz, "
                  "f, fx fy fz",
                  printable(meaning)));
}

// The meanings that a range of columns has: p, q, r, v, m, a, g, f.
std::vector<std::string> meanings_of_range(std::string_view letter, std::string_view quaternion_order) {
  if (letter == "q") {
    std::vector<std::string> out;
    for (const char c : quaternion_order) out.push_back(std::string("q") + c);
    return out;
  }
  if (letter == "f") return {"fx", "fy", "fz"};
  for (const MeaningWords& words : kMeanings) {
    if (letter.size() == 1 && words.names.starts_with(letter) && words.names.front() != 't')
      return words_of(words.names);
  }
  return {};
}

// Entries between commas that are neither quoted nor in brackets.
std::vector<std::string_view> entries_of(std::string_view text) {
  std::vector<std::string_view> out;
  std::size_t begin = 0;
  char quote = 0;
  int depth = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ',';
    if (quote != 0 && i < text.size()) {
      if (c == quote) quote = 0;
    } else if (c == '\'' || c == '"') {
      quote = c;
    } else if (c == '[' || c == '(') {
      ++depth;
    } else if (c == ']' || c == ')') {
      --depth;
    } else if (i == text.size() || (c == ',' && depth <= 0)) {
      const std::string_view entry = trim(text.substr(begin, i - begin));
      if (!entry.empty()) out.push_back(entry);
      begin = i + 1;
    }
  }
  return out;
}

std::optional<std::size_t> column_number(std::string_view text) {
  if (!text.starts_with('#')) return std::nullopt;
  const auto number = parse_int64(text.substr(1));
  if (!number || *number < 1) return std::nullopt;
  return static_cast<std::size_t>(*number);
}

std::string lower_case(std::string_view text) {
  std::string out;
  for (const char c : text) out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

// The columns for which `same` holds, at the first of the rules that finds any.
std::vector<std::size_t> columns_named(const DelimitedTable& table, std::string_view name) {
  const std::string lower = lower_case(name);
  const auto collect = [&](const auto& same) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      if (same(table.columns[i])) out.push_back(i);
    }
    return out;
  };
  auto found = collect([&](const DelimitedColumn& c) { return c.label() == name; });
  if (found.empty()) found = collect([&](const DelimitedColumn& c) { return c.name == name; });
  if (found.empty()) found = collect([&](const DelimitedColumn& c) { return lower_case(c.label()) == lower; });
  if (found.empty()) found = collect([&](const DelimitedColumn& c) { return lower_case(c.name) == lower; });
  if (found.empty()) {
    found = collect([&](const DelimitedColumn& c) { return lower_case(c.label()).ends_with(" " + lower); });
  }
  return found;
}

}  // namespace

ColumnGroup group_of(std::string_view meaning) { return meaning_words(meaning).group; }
Quantity quantity_of(std::string_view meaning) { return meaning_words(meaning).quantity; }

const MappedColumn* find_meaning(const ColumnMap& map, std::string_view meaning) {
  for (const MappedColumn& column : map) {
    if (column.meaning == meaning) return &column;
  }
  return nullptr;
}

bool has_group(const ColumnMap& map, ColumnGroup group) {
  return std::any_of(map.begin(), map.end(), [&](const auto& column) { return group_of(column.meaning) == group; });
}

std::vector<StatedColumn> parse_columns(std::string_view text, std::string_view quaternion_order,
                                        std::string_view what) {
  std::vector<StatedColumn> out;
  for (const std::string_view entry : entries_of(text)) {
    const auto fail = [&](const std::string& message) -> Error {
      return Error(fmt::format("{}: '{}': {}", what, printable(entry), message));
    };
    const auto equals = entry.find('=');
    if (equals == std::string_view::npos) throw fail("a meaning, = and a column are expected, such as px=X[mm]");
    StatedColumn stated;
    stated.meaning = std::string(trim(entry.substr(0, equals)));
    std::string_view column = trim(entry.substr(equals + 1));
    if (column.starts_with('-')) {
      stated.negative = true;
      column = trim(column.substr(1));
    }
    if (column.ends_with(']')) {
      const auto open = column.rfind('[');
      if (open == std::string_view::npos) throw fail("a bracket is not opened");
      stated.unit = std::string(trim(column.substr(open + 1, column.size() - open - 2)));
      column = trim(column.substr(0, open));
    }
    if (column.size() >= 2 && (column.front() == '\'' || column.front() == '"') && column.back() == column.front()) {
      column = column.substr(1, column.size() - 2);
    }
    if (column.empty()) throw fail("the column is missing");
    stated.column = std::string(column);
    const auto dash = column.find("-#");
    const auto first = column_number(column.substr(0, dash));
    const auto last = dash == std::string_view::npos ? std::nullopt : column_number(column.substr(dash + 1));
    if (first && last) {
      const auto meanings = meanings_of_range(stated.meaning, quaternion_order);
      if (meanings.empty()) throw fail("a range of columns is p, q, r, v, m, a, g or f");
      if (*last < *first || *last - *first + 1 != meanings.size()) {
        throw fail(fmt::format("{} columns are expected", meanings.size()));
      }
      for (std::size_t i = 0; i < meanings.size(); ++i) {
        out.push_back({meanings[i], "#" + std::to_string(*first + i), stated.unit, stated.negative});
      }
      continue;
    }
    try {
      if (!stated.unit.empty()) parse_import_unit(stated.unit, quantity_of(stated.meaning), "unit");
      group_of(stated.meaning);
    } catch (const Error& error) {
      throw fail(error.what());
    }
    out.push_back(std::move(stated));
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t k = i + 1; k < out.size(); ++k) {
      if (out[i].meaning == out[k].meaning) throw Error(fmt::format("{}: '{}' is stated twice", what, out[i].meaning));
    }
  }
  return out;
}

MappedColumn find_stated_column(const StatedColumn& stated, const DelimitedTable& table) {
  const std::string where = fmt::format("{}: {}={}", table.file, stated.meaning, printable(stated.column));
  std::size_t column = 0;
  std::string name_unit;
  if (const auto number = column_number(stated.column)) {
    if (*number > table.columns.size()) {
      throw Error(fmt::format("{}: the table has {} columns", where, table.columns.size()));
    }
    column = *number - 1;
  } else {
    auto found = columns_named(table, stated.column);
    if (found.empty()) {
      // "Time (Seconds)" is the column 'Time' with its unit.
      const NameAndUnit parts = split_name_and_unit(stated.column);
      found = columns_named(table, parts.name);
      name_unit = parts.unit;
    }
    if (found.empty()) throw Error(fmt::format("{}: no such column; there are {}", where, column_list(table)));
    if (found.size() > 1) throw Error(fmt::format("{}: this can be {}", where, column_list(table, found)));
    column = found.front();
  }
  MappedColumn out{stated.meaning, column, {}, stated.negative, "stated", {}};
  const Quantity quantity = quantity_of(stated.meaning);
  const std::string& header_unit = table.columns[column].unit.empty() ? name_unit : table.columns[column].unit;
  if (!stated.unit.empty()) {
    out.unit = parse_import_unit(stated.unit, quantity, where).name;
    out.unit_why = "stated";
  } else if (quantity != Quantity::kNumber && !header_unit.empty()) {
    out.unit = parse_import_unit(header_unit, quantity, fmt::format("{}: {}", table.file, table.describe(column))).name;
    out.unit_why = "header";
  }
  return out;
}

std::string column_list(const DelimitedTable& table) {
  std::vector<std::size_t> all(table.columns.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return column_list(table, all);
}

std::string column_list(const DelimitedTable& table, const std::vector<std::size_t>& columns) {
  constexpr std::size_t kMostListed = 24;
  std::string out;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i == kMostListed) return out + fmt::format(" and {} more", columns.size() - i);
    const std::string label = table.columns[columns[i]].label();
    out += fmt::format("{}#{}{}", i == 0 ? "" : ", ", columns[i] + 1,
                       label.empty() ? std::string() : " '" + printable(label) + "'");
  }
  return out;
}

std::string columns_text(const ColumnMap& map, const DelimitedTable& table) {
  std::string out;
  for (const MappedColumn& column : map) {
    const std::string label = table.columns[column.column].label();
    const bool plain = !label.empty() && label.find_first_of("'\"#=[]-") == std::string::npos &&
                       columns_named(table, label) == std::vector<std::size_t>{column.column};
    const std::string name = plain ? "'" + label + "'" : "#" + std::to_string(column.column + 1);
    const std::string unit = quantity_of(column.meaning) == Quantity::kNumber ? "" : "[" + column.unit + "]";
    out += fmt::format("{}{}={}{}{}", out.empty() ? "" : ", ", column.meaning, column.negative ? "-" : "", name, unit);
  }
  return out;
}

}  // namespace asperity

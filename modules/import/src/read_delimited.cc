#include "asperity/import/read_delimited.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include <fmt/format.h>
#include "asperity/base/crc32.h"
#include "asperity/base/csv.h"
#include "asperity/base/decode_text.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "delimited_layout.h"
#include "header_names.h"
#include "split_cells.h"

namespace asperity {

namespace {

constexpr std::size_t kMostColumns = 1000;

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

struct SectionStart {
  std::size_t at = 0;
  std::size_t line = 1;
};

// The line behind the one whose only word is `section`.
SectionStart find_section(const DelimitedTable& table, std::string_view section) {
  SectionStart out;
  if (section.empty()) return out;
  const std::string_view text = table.text;
  while (out.at < text.size()) {
    const std::size_t end = std::min(text.find('\n', out.at), text.size());
    std::string_view line = trim(text.substr(out.at, end - out.at));
    while (!line.empty() && (line.back() == ',' || line.back() == ';')) line.remove_suffix(1);
    out.at = std::min(end + 1, text.size());
    ++out.line;
    if (same_letters(trim(line), section)) return out;
  }
  throw Error(fmt::format("{}: no section '{}' is in it", table.file, printable(section)));
}

// Takes the rows in, one line after the other.
class RowReader {
 public:
  RowReader(DelimitedTable& table, std::size_t columns, const Observer& observer) : table_(table), watch_(observer) {
    table_.columns.resize(columns);
  }

  void read(std::size_t begin, std::size_t first_line) {
    const std::string_view text = table_.text;
    std::size_t at = begin;
    bool behind_blank = false;
    for (std::size_t line = first_line; at < text.size(); ++line) {
      watch_.next();
      const std::size_t end = text.find('\n', at);
      if (end == std::string_view::npos) {
        note("truncated", line, "the last line has no end, as after a power cut; it was left out");
        return;
      }
      const std::string_view content = text.substr(at, end - at);
      if (trim(content).empty() || is_comment_line(content)) {
        behind_blank = true;
      } else if (!take(content, at, line, behind_blank)) {
        note("further_table", line, "a further part of the file begins here; it was not read");
        return;
      } else {
        behind_blank = false;
      }
      at = end + 1;
    }
  }

 private:
  // False if the line begins another part of the file.
  bool take(std::string_view content, std::size_t at, std::size_t line, bool behind_blank) {
    if (!split_cells(content, table_.separator, cells_)) fail(line, cells_.size(), "a quote is not closed");
    parsed_.clear();
    bool any_text = false, any_number = false;
    for (const std::string_view cell : cells_) {
      parsed_.push_back(parse_cell(cell));
      any_text |= parsed_.back().kind == CellKind::kText;
      any_number |= parsed_.back().kind == CellKind::kNumber || parsed_.back().kind == CellKind::kTime;
    }
    if (any_text && !any_number && (behind_blank || cells_.size() == 1)) return false;
    const std::size_t width = table_.columns.size();
    for (std::size_t i = width; i < cells_.size(); ++i) {
      if (!cells_[i].empty()) {
        throw Error(fmt::format("{}:{}: {} cells where the first row has {}", table_.file, line, cells_.size(), width));
      }
    }
    if (cells_.size() < width) note("short_row", line, "a row ends before the last column; its last cells are missing");
    for (std::size_t i = 0; i < width; ++i) add_cell(i, line);
    table_.row_begin.push_back(at);
    table_.row_line.push_back(static_cast<std::uint32_t>(line));
    return true;
  }

  void add_cell(std::size_t column, std::size_t line) {
    DelimitedColumn& out = table_.columns[column];
    double value = std::numeric_limits<double>::quiet_NaN();
    if (column < parsed_.size()) {
      const ParsedCell& cell = parsed_[column];
      if (cell.kind == CellKind::kNumber) {
        value = cell.value;
        points_ = points_ || cell.has_point;
        commas_ = commas_ || cell.has_comma;
        if (points_ && commas_) {
          fail(line, column,
               fmt::format("'{}' has another decimal mark than the cells before it", printable(cells_[column])));
        }
        table_.decimal_comma = commas_;
      } else if (cell.kind != CellKind::kMissing) {
        out.has_text = true;
      }
    }
    out.values.push_back(value);
  }

  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& message) const {
    const std::string where =
        column < table_.columns.size() ? table_.describe(column) : "column #" + std::to_string(column + 1);
    throw Error(fmt::format("{}:{}: {}: {}", table_.file, line, where, message));
  }

  void note(const char* kind, std::size_t line, const char* message) {
    for (Problem& problem : table_.problems) {
      if (problem.kind == kind) {
        ++problem.count;
        return;
      }
    }
    table_.problems.push_back({kind, fmt::format("{}:{}: {}", table_.file, line, message), 1});
  }

  DelimitedTable& table_;
  RowWatch watch_;
  std::vector<std::string_view> cells_;
  std::vector<ParsedCell> parsed_;
  bool points_ = false;
  bool commas_ = false;
};

}  // namespace

bool DelimitedTable::has_header() const {
  return std::any_of(columns.begin(), columns.end(), [](const auto& column) { return !column.name.empty(); });
}

std::string_view DelimitedTable::cell(std::size_t row, std::size_t column) const {
  const std::size_t begin = row_begin.at(row);
  std::vector<std::string_view> cells;
  split_cells(std::string_view(text).substr(begin, text.find('\n', begin) - begin), separator, cells);
  return column < cells.size() ? cells[column] : std::string_view{};
}

std::string DelimitedTable::preface_value(std::string_view key) const {
  std::vector<std::string_view> cells;
  for (const std::string& line : preface) {
    if (!split_cells(line, separator, cells)) continue;
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
      if (same_letters(cells[i], key)) return std::string(cells[i + 1]);
    }
  }
  return {};
}

std::string DelimitedTable::describe(std::size_t column) const {
  const std::string label = columns.at(column).label();
  const std::string number = "column #" + std::to_string(column + 1);
  return label.empty() ? number : number + " '" + printable(label) + "'";
}

DelimitedTable read_delimited(std::string text, const std::string& name, std::string_view section,
                              const Observer& observer) {
  DelimitedTable out;
  out.file = name;
  out.bytes = text.size();
  out.crc32 = crc32(std::string_view(text));
  DecodedText decoded = decode_text(std::move(text), name);
  out.text = std::move(decoded.text);
  if (decoded.was_latin1) {
    out.problems.push_back(
        {"latin1", name + ": not UTF-8; read as Latin-1 (save it as UTF-8 if letters are wrong)", 1});
  }
  const SectionStart start = find_section(out, section);
  const DelimitedLayout layout = find_layout(out.text, name, start.at, start.line);
  out.separator = layout.separator;
  for (const TextLine& line : layout.preface) {
    out.preface.emplace_back(trim(std::string_view(out.text).substr(line.begin, line.end - line.begin)));
  }
  std::vector<std::string_view> cells;
  const std::size_t data_end = std::min(out.text.find('\n', layout.data_begin), out.text.size());
  split_cells(std::string_view(out.text).substr(layout.data_begin, data_end - layout.data_begin), out.separator, cells);
  // A separator behind the last cell makes no column.
  while (cells.size() > 1 && cells.back().empty() && layout.header.empty()) cells.pop_back();
  if (cells.size() > kMostColumns) {
    throw Error(fmt::format("{}:{}: more than {} columns", name, layout.data_line, kMostColumns));
  }
  std::vector<DelimitedColumn> names(cells.size());
  name_columns(out.text, layout, names);
  out.columns = std::move(names);
  RowReader reader(out, out.columns.size(), observer);
  reader.read(layout.data_begin, layout.data_line);
  if (out.rows() == 0) throw Error(fmt::format("{}:{}: no complete row was found", name, layout.data_line));
  return out;
}

DelimitedTable read_delimited_file(const std::filesystem::path& path, std::string_view section,
                                   const ReadLimits& limits) {
  return read_delimited(read_file(path, limits.csv_bytes), path.string(), section);
}

}  // namespace asperity

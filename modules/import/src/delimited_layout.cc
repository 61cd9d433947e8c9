#include "delimited_layout.h"

#include <algorithm>
#include <array>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "split_cells.h"

namespace asperity {

namespace {

constexpr std::size_t kMostLines = 5000;  // that may stand above the rows
constexpr std::size_t kSampleBytes = std::size_t{4} << 20;
constexpr std::size_t kRowsToBelieve = 3;

std::vector<TextLine> first_lines(std::string_view text, std::size_t from, std::size_t from_line) {
  std::vector<TextLine> out;
  std::size_t at = from;
  for (std::size_t line = from_line; at < text.size() && out.size() < kMostLines && at - from < kSampleBytes; ++line) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back({at, end, line});
    at = end + 1;
  }
  return out;
}

struct RowKind {
  std::size_t cells = 0;
  std::size_t numbers = 0;  // numbers and times
  std::size_t texts = 0;

  bool is_row() const { return numbers > texts; }
};

RowKind row_kind(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  RowKind out;
  if (!split_cells(line, separator, cells)) return out;
  for (const std::string_view cell : cells) {
    const CellKind kind = parse_cell(cell).kind;
    if (kind == CellKind::kNumber || kind == CellKind::kTime) ++out.numbers;
    if (kind == CellKind::kText) ++out.texts;
  }
  out.cells = cells.size();
  return out;
}

bool is_blank_line(std::string_view line) { return trim(line).empty(); }

std::string_view line_text(std::string_view text, const TextLine& line) {
  return text.substr(line.begin, line.end - line.begin);
}

// The separator by which the lines hold most numbers with least text between them.
char find_separator(std::string_view text, const std::vector<TextLine>& lines) {
  constexpr std::array<char, 4> kCandidates{'\t', ';', ',', ' '};
  constexpr std::size_t kMostSampled = 400;
  // The last of the lines are rows if any are.
  const std::size_t first = lines.size() > kMostSampled ? lines.size() - kMostSampled : 0;
  char best = ',';
  long best_score = 0;
  std::vector<std::string_view> cells;
  for (const char separator : kCandidates) {
    long score = 0;
    for (std::size_t i = first; i < lines.size(); ++i) {
      const std::string_view line = line_text(text, lines[i]);
      if (is_blank_line(line) || is_comment_line(line)) continue;
      const RowKind kind = row_kind(line, separator, cells);
      if (kind.is_row()) score += static_cast<long>(kind.numbers) - 2 * static_cast<long>(kind.texts);
    }
    if (score > best_score) {
      best = separator;
      best_score = score;
    }
  }
  return best;
}

// The first of the lines that is a row, with those behind it; lines.size() if there is none.
std::size_t find_first_row(std::string_view text, const std::vector<TextLine>& lines, char separator) {
  std::vector<std::string_view> cells;
  std::size_t run = 0, run_begin = lines.size();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = line_text(text, lines[i]);
    if (is_blank_line(line) || is_comment_line(line)) continue;
    const RowKind kind = row_kind(line, separator, cells);
    if (!kind.is_row()) {
      run = 0;
      run_begin = lines.size();
      continue;
    }
    if (run++ == 0) run_begin = i;
    if (run == kRowsToBelieve) return run_begin;
  }
  return run > 0 ? run_begin : lines.size();
}

// Header rows have about as many cells as the rows, or begin with a blank one (groups).
bool is_header_row(std::string_view line, char separator, std::size_t width, std::vector<std::string_view>& cells) {
  if (!split_cells(line, separator, cells)) return false;
  if (cells.empty() || cells.size() > width + 1 + (separator == ' ' ? width : 0)) return false;
  if (width > 1 && cells.size() < 2) return false;
  const bool any = std::any_of(cells.begin(), cells.end(), [](std::string_view cell) { return !cell.empty(); });
  return any && (2 * cells.size() >= width || cells.front().empty());
}

void find_header(std::string_view text, const std::vector<TextLine>& lines, std::size_t first_row, std::size_t width,
                 DelimitedLayout& out) {
  std::vector<std::string_view> cells;
  std::size_t top = first_row;
  while (top > 0) {
    const std::string_view line = line_text(text, lines[top - 1]);
    if (is_blank_line(line) || is_comment_line(line) || !is_header_row(line, out.separator, width, cells)) break;
    --top;
  }
  if (top == first_row && top > 0 && is_comment_line(line_text(text, lines[top - 1]))) {
    TextLine line = lines[top - 1];
    const std::size_t name = text.find_first_not_of("#%/ \t", line.begin);
    line.begin = std::min(name, line.end);
    if (split_cells(line_text(text, line), out.separator, cells) && cells.size() >= width &&
        row_kind(line_text(text, line), out.separator, cells).texts * 2 > width && line.begin < line.end) {
      out.header.push_back(line);
      out.header_is_comment = true;
      --top;
    }
  } else {
    out.header.assign(lines.begin() + static_cast<std::ptrdiff_t>(top),
                      lines.begin() + static_cast<std::ptrdiff_t>(first_row));
  }
  out.preface.assign(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(top));
}

}  // namespace

DelimitedLayout find_layout(std::string_view text, const std::string& name, std::size_t from, std::size_t from_line) {
  const std::vector<TextLine> lines = first_lines(text, from, from_line);
  DelimitedLayout out;
  out.separator = find_separator(text, lines);
  const std::size_t first_row = find_first_row(text, lines, out.separator);
  if (first_row == lines.size()) {
    throw Error(name + ":" + std::to_string(from_line) + ": no table of numbers is found");
  }
  std::vector<std::string_view> cells;
  const std::size_t width = row_kind(line_text(text, lines[first_row]), out.separator, cells).cells;
  find_header(text, lines, first_row, width, out);
  out.data_begin = lines[first_row].begin;
  out.data_line = lines[first_row].number;
  return out;
}

}  // namespace asperity

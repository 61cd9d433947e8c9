#include "explain_code.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace asperity::app {

extern const char* const kTroubleshootingPage;  // docs/troubleshooting.md, made by CMake

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

// The cells of a row of a table in Markdown; `\|` is part of a cell.
std::vector<std::string> cells_of(std::string_view row) {
  std::vector<std::string> out(1);
  row.remove_prefix(1);
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == '|') {
      out.emplace_back();
    } else {
      if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') ++i;
      out.back() += row[i];
    }
  }
  out.pop_back();  // after the last bar
  for (std::string& cell : out) cell = trimmed(cell);
  return out;
}

// Without the marks of Markdown: links are their words, code stands in quotes.
std::string plain(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`') {
      out += '\'';
    } else if (text.substr(i, 2) == "**") {
      ++i;
    } else if (text[i] == '[') {
      const std::size_t end = text.find("](", i), closed = text.find(')', i);
      if (end == std::string_view::npos || closed == std::string_view::npos || closed < end) {
        out += text[i];
        continue;
      }
      out += plain(text.substr(i + 1, end - i - 1));
      i = closed;
    } else {
      out += text[i];
    }
  }
  return out;
}

std::string wrapped(std::string_view text, std::string_view indent) {
  constexpr std::size_t kWidth = 100;
  std::string out, line(indent);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    if (line.size() > indent.size() && line.size() + 1 + word.size() > kWidth) {
      out += line + "\n";
      line = indent;
    }
    if (line.size() > indent.size()) line += ' ';
    line += word;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out + line + "\n";
}

}  // namespace

std::optional<std::string> explain_code(std::string_view code) {
  const std::string anchor = "| <a id=\"" + std::string(code) + "\"></a>";
  const std::string_view page = kTroubleshootingPage;
  const std::size_t at = page.find("\n" + anchor);
  if (code.empty() || code.find_first_of("\"\n") != std::string_view::npos || at == std::string_view::npos) return {};
  const std::vector<std::string> cells = cells_of(page.substr(at + 1, page.find('\n', at + 1) - at - 1));
  if (cells.size() < 3) return {};
  const bool severe = cells.size() > 3;  // code, severity, meaning, what to do; exit codes have no severity
  std::string out = std::string(code) + (severe ? " (" + cells[1] + ")" : "") + "\n";
  out += wrapped(plain(cells[severe ? 2 : 1]), "  ");
  const std::string& remedy = cells[severe ? 3 : 2];
  if (!remedy.empty()) out += wrapped("What to do: " + plain(remedy), "  ");
  return out + "  docs/troubleshooting.md#" + std::string(code) + "\n";
}

}  // namespace asperity::app

#include "statement_lines.h"

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

StatementLines::StatementLines(std::string_view text, const std::string& name, std::size_t line_bytes,
                               const Observer& observer)
    : name_(name), text_(text), line_bytes_(line_bytes), watch_(observer) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  if (text_.starts_with("\xFE\xFF") || text_.starts_with("\xFF\xFE")) {
    throw Error(name_ + ": is UTF-16 text; save it as UTF-8 or ASCII");
  }
  if (const auto nul = text_.substr(0, 4096).find('\0'); nul != std::string_view::npos) {
    throw Error(name_ + ": is binary or UTF-16, not a text file: byte " + std::to_string(nul) + " is zero");
  }
}

std::string StatementLines::place() const { return name_ + ":" + std::to_string(line_); }

void StatementLines::fail(const std::string& message) const { throw Error(place() + ": " + message); }

std::string_view StatementLines::physical_line() {
  const std::size_t newline = text_.find('\n');
  std::string_view line = text_.substr(0, newline);
  text_.remove_prefix(newline == std::string_view::npos ? text_.size() : newline + 1);
  ++lines_read_;
  if (line.size() > line_bytes_) {
    line_ = lines_read_;
    fail("the line is longer than " + std::to_string(line_bytes_) + " bytes");
  }
  while (!line.empty() && (line.back() == '\r' || is_blank(line.back()))) line.remove_suffix(1);
  if (line.find('\r') != std::string_view::npos) {
    line_ = lines_read_;
    fail("a carriage return inside the line; lines end with \\n or \\r\\n");
  }
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

std::string_view StatementLines::joined(std::string_view first) {
  buffer_.assign(first);
  while (!buffer_.empty() && buffer_.back() == '\\' && !text_.empty()) {
    buffer_.back() = ' ';
    buffer_ += physical_line();
    if (buffer_.size() > line_bytes_) fail("the joined line is longer than " + std::to_string(line_bytes_) + " bytes");
  }
  while (!buffer_.empty() && (buffer_.back() == '\\' || is_blank(buffer_.back()))) buffer_.pop_back();
  return trim(buffer_);
}

bool StatementLines::next() {
  while (!text_.empty()) {
    watch_.next();
    std::string_view line = physical_line();
    line_ = lines_read_;
    if (line.empty() || line.front() == '#') continue;
    if (line.back() == '\\') line = joined(line);
    if (line.empty() || line.front() == '#') continue;
    std::size_t length = 0;
    while (length < line.size() && !is_blank(line[length])) ++length;
    keyword_ = line.substr(0, length);
    while (length < line.size() && is_blank(line[length])) ++length;
    rest_ = line.substr(length);
    return true;
  }
  return false;
}

std::string_view next_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && is_blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  if (!word.empty() && word.front() == '#') {
    text = {};
    return {};
  }
  text.remove_prefix(end);
  return word;
}

}  // namespace asperity

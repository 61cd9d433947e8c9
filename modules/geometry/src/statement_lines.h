#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"

namespace asperity {

// The lines of an OBJ or MTL file as statements: a UTF-8 byte order mark, comments and blank lines are
// passed over, lines that end with a backslash are joined with the next.
class StatementLines {
 public:
  // Throws Error if the text is not made of bytes that such a file has.
  StatementLines(std::string_view text, const std::string& name, std::size_t line_bytes, const Observer& observer = {});

  // Goes to the next statement; false at the end. Throws Cancelled if the observer says so.
  bool next();

  std::string_view keyword() const { return keyword_; }
  std::string_view rest() const { return rest_; }  // what follows the keyword, blanks at its ends removed
  std::size_t line() const { return line_; }       // on which the statement begins, from 1
  std::string place() const;                       // "file:line"
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string_view physical_line();
  std::string_view joined(std::string_view first);

  const std::string& name_;
  std::string_view text_;
  std::size_t line_bytes_;
  std::size_t lines_read_ = 0;
  std::size_t line_ = 0;
  std::string_view keyword_;
  std::string_view rest_;
  std::string buffer_;
  RowWatch watch_;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

// The next word of `text`, which loses it; empty at the end and where a comment begins.
std::string_view next_word(std::string_view& text);

}  // namespace asperity

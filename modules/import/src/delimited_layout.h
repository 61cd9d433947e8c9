#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

struct TextLine {
  std::size_t begin = 0;
  std::size_t end = 0;  // without \n
  std::size_t number = 0;
};

// Where a table's parts are in a text.
struct DelimitedLayout {
  char separator = ',';
  std::vector<TextLine> preface;
  std::vector<TextLine> header;  // from top to bottom
  bool header_is_comment = false;
  std::size_t data_begin = 0;  // the first row's first byte
  std::size_t data_line = 0;   // its line, from 1
};

// Finds them; `from` and `from_line` are where to begin. Looks at no more than the first lines of the text. Throws
// Error naming the file if no rows of numbers are among them.
DelimitedLayout find_layout(std::string_view text, const std::string& name, std::size_t from, std::size_t from_line);

}  // namespace asperity

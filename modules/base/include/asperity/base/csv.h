#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

// A file's whole content. Throws Error if it cannot be read or is larger than `limit_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t limit_bytes);

// Reads a comma-separated file with a header line, row by row, from text held in memory. Lines end
// with \n or \r\n; blank lines and lines that begin with # are passed over. No quoting: none of our
// formats needs it.
class CsvReader {
 public:
  // `name` is what messages call the file. Throws Error if the header is missing, not UTF-8, or has
  // an empty or repeated column.
  CsvReader(std::string_view text, std::string name);

  const std::vector<std::string>& columns() const { return columns_; }
  // The place of a column, or nullopt; `require` throws Error naming the file and the column.
  std::optional<std::size_t> find(std::string_view column) const;
  std::size_t require(std::string_view column) const;

  // Goes to the next row; false at the end. Throws Error for a row with another number of cells.
  // A last line without its newline is not taken: see truncated().
  bool next();
  std::string_view cell(std::size_t column) const { return cells_[column]; }
  bool empty(std::size_t column) const { return cells_[column].empty(); }
  double number(std::size_t column) const;         // throws Error unless the cell is a number (nan allowed)
  std::int64_t integer(std::size_t column) const;  // throws Error unless the cell is a whole number
  std::size_t line() const { return line_; }       // of the current row, from 1

  // True once the end was reached if the last line had no newline: its content may be cut off, so it
  // was passed over, unless `accept_unterminated` was set before.
  bool truncated() const { return truncated_; }
  void accept_unterminated() { accept_unterminated_ = true; }

  // "file:line: column 'x': message"
  [[noreturn]] void fail(std::size_t column, const std::string& message) const;

 private:
  bool next_line(std::string_view& line);

  std::string name_;
  std::string_view rest_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> cells_;
  std::size_t line_ = 0;
  bool truncated_ = false;
  bool accept_unterminated_ = false;
};

}  // namespace asperity

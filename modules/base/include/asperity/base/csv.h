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

enum class CsvHeader {
  kRequired,
  kOptional,  // the first line is a row if all its cells are numbers
};

// Reads comma-separated values row by row from text held in memory. Lines end with \n or \r\n; blank lines and lines
// that begin with # are passed over. No quoting: none of our formats needs it.
class CsvReader {
 public:
  // `name` is what messages call the file. Throws Error if the first line is missing, or is a header that is not UTF-8
  // or has an empty or repeated column.
  CsvReader(std::string_view text, std::string name, CsvHeader header = CsvHeader::kRequired);

  const std::vector<std::string>& columns() const { return columns_; }  // empty without a header
  std::size_t width() const { return cells_.size(); }
  // The place of a column, or nullopt; `require` throws Error naming the file and the column.
  std::optional<std::size_t> find(std::string_view column) const;
  std::size_t require(std::string_view column) const;

  // Goes to the next row; false at the end. Throws Error for a row with another number of cells.
  // A last line without its newline is not taken: see truncated().
  bool next();
  std::string_view cell(std::size_t column) const { return cells_[column]; }
  bool empty(std::size_t column) const { return cells_[column].empty(); }
  double number(std::size_t column) const;         // throws Error unless the cell is a number (nan allowed)
  double finite(std::size_t column) const;         // throws Error unless it is a finite number
  double finite_or_nan(std::size_t column) const;  // throws Error unless it is a finite number or nan
  std::int64_t integer(std::size_t column) const;  // throws Error unless the cell is a whole number
  std::size_t line() const { return line_; }       // of the current row, from 1

  // True once the end was reached if the last line had no newline: its content may be cut off, so it
  // was passed over, unless `accept_unterminated` was set before.
  bool truncated() const { return truncated_; }
  void accept_unterminated() { accept_unterminated_ = true; }

  // "file:line: column 'x': message" (by its number without a header), and "file:line: message".
  [[noreturn]] void fail(std::size_t column, const std::string& message) const;
  [[noreturn]] void fail(const std::string& message) const;

 private:
  bool next_line(std::string_view& line);
  void take_header();

  std::string name_;
  std::string_view rest_;
  std::vector<std::string> columns_;
  std::vector<std::string_view> cells_;
  std::size_t line_ = 0;
  bool truncated_ = false;
  bool accept_unterminated_ = false;
  bool first_row_pending_ = false;
};

}  // namespace asperity

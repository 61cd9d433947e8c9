#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity {

struct JsonStyle {
  int indent = 1;                   // blanks a level
  bool plain_whole_numbers = true;  // 1000000 and -0.0; otherwise the shortest text: 1e+06 and -0
};

// Writes an object with one key a line, arrays of numbers and what is begun inline on one line. Throws Error for nan,
// inf and texts that are not UTF-8.
class JsonWriter {
 public:
  // `depth`: how many objects the text will stand in.
  explicit JsonWriter(JsonStyle style = {}, int depth = 0) : style_(style), depth_(depth) { open('{'); }

  void number(std::string_view key, double number);
  void integer(std::string_view key, std::int64_t value);
  void text(std::string_view key, std::string_view value);
  void boolean(std::string_view key, bool value);
  void numbers(std::string_view key, const double* values, std::size_t count);
  void numbers(std::string_view key, const std::vector<double>& values) { numbers(key, values.data(), values.size()); }
  // `rows` lists of `columns` numbers, which are kept column by column.
  void matrix(std::string_view key, const double* values, std::size_t rows, std::size_t columns);
  void raw(std::string_view key, std::string_view json);

  void begin_object(std::string_view key);
  void begin_inline(std::string_view key);  // an object on one line, until its end_object()
  void begin_array(std::string_view key);
  void begin_element();  // an object in an array
  void end_object() { close('}'); }
  void end_array() { close(']'); }
  // The text so far, its last bracket closed; finish() ends the line, too.
  std::string take();
  std::string finish() { return take() + '\n'; }

 private:
  void open(char bracket);
  void close(char bracket);
  void next(std::string_view key);
  void value(double number, std::string_view key);
  void row(const double* values, std::size_t count, std::size_t stride, std::string_view key);

  JsonStyle style_;
  std::string out_;
  int depth_ = 0;
  bool first_ = true;
  bool inline_ = false;
};

}  // namespace asperity

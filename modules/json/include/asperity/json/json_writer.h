#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace asperity {

// Writes JSON with one key a line and arrays of numbers on one line. Throws Error for nan and inf.
class JsonWriter {
 public:
  JsonWriter() { open('{'); }

  void number(std::string_view key, double number);
  void integer(std::string_view key, std::int64_t value);
  void text(std::string_view key, std::string_view value);
  void boolean(std::string_view key, bool value);
  void numbers(std::string_view key, const double* values, std::size_t count);
  // `rows` lists of `columns` numbers, which are kept column by column.
  void matrix(std::string_view key, const double* values, std::size_t rows, std::size_t columns);
  void raw(std::string_view key, std::string_view json);

  void begin_object(std::string_view key);
  void begin_array(std::string_view key);
  void begin_element();  // an object in an array
  void end_object() { close('}'); }
  void end_array() { close(']'); }
  std::string finish();

 private:
  void open(char bracket);
  void close(char bracket);
  void next(std::string_view key);
  void value(double number, std::string_view key);
  void row(const double* values, std::size_t count, std::size_t stride, std::string_view key);

  std::string out_;
  int depth_ = 0;
  bool first_ = true;
};

}  // namespace asperity

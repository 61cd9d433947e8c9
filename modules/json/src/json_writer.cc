#include "asperity/json/json_writer.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "json_text.h"

namespace asperity {

void JsonWriter::open(char bracket) {
  out_ += bracket;
  ++depth_;
  first_ = true;
}

void JsonWriter::close(char bracket) {
  --depth_;
  if (!first_ && !inline_) {
    out_ += '\n';
    out_.append(static_cast<std::size_t>(depth_ * style_.indent), ' ');
  }
  out_ += bracket;
  first_ = inline_ = false;
}

void JsonWriter::next(std::string_view key) {
  if (inline_) {
    out_ += first_ ? "" : ", ";
  } else {
    out_ += first_ ? "\n" : ",\n";
    out_.append(static_cast<std::size_t>(depth_ * style_.indent), ' ');
  }
  first_ = false;
  if (key.empty()) return;
  append_json_text(out_, key, false);
  out_ += ": ";
}

void JsonWriter::value(double number, std::string_view key) {
  if (!std::isfinite(number)) {
    throw Error(std::string(key) + ": " + number_text(number) + " cannot be written to a file");
  }
  if (!style_.plain_whole_numbers) {
    append_number(out_, number);
  } else if (number == 0.0 && std::signbit(number)) {
    out_ += "-0.0";  // JSON readers take -0 for the integer 0
  } else {
    append_exact(out_, number);
  }
}

void JsonWriter::row(const double* values, std::size_t count, std::size_t stride, std::string_view key) {
  out_ += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) out_ += ", ";
    value(values[i * stride], key);
  }
  out_ += ']';
}

void JsonWriter::number(std::string_view key, double number) {
  next(key);
  value(number, key);
}

void JsonWriter::integer(std::string_view key, std::int64_t value) {
  next(key);
  append_number(out_, value);
}

void JsonWriter::text(std::string_view key, std::string_view value) {
  if (!is_utf8(value)) throw Error(std::string(key) + ": '" + printable(value) + "' is not UTF-8 text");
  next(key);
  append_json_text(out_, value, false);
}

void JsonWriter::boolean(std::string_view key, bool value) {
  next(key);
  out_ += value ? "true" : "false";
}

void JsonWriter::numbers(std::string_view key, const double* values, std::size_t count) {
  next(key);
  row(values, count, 1, key);
}

void JsonWriter::matrix(std::string_view key, const double* values, std::size_t rows, std::size_t columns) {
  next(key);
  out_ += '[';
  for (std::size_t i = 0; i < rows; ++i) {
    if (i > 0) out_ += ", ";
    row(values + i, columns, rows, key);
  }
  out_ += ']';
}

void JsonWriter::raw(std::string_view key, std::string_view value_json) {
  next(key);
  out_ += value_json;
}

void JsonWriter::begin_object(std::string_view key) {
  next(key);
  open('{');
}

void JsonWriter::begin_inline(std::string_view key) {
  begin_object(key);
  inline_ = true;
}

void JsonWriter::begin_array(std::string_view key) {
  next(key);
  open('[');
}

void JsonWriter::begin_element() {
  next("");
  open('{');
}

std::string JsonWriter::take() {
  close('}');
  return std::move(out_);
}

}  // namespace asperity

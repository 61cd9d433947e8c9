#include "json_writer.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

void append_exact(std::string& out, double value) {
  constexpr double kWholeNumbers = 9007199254740992.0;  // 2^53: all whole numbers below are exact
  if (std::abs(value) < kWholeNumbers && value == std::trunc(value) && !(value == 0.0 && std::signbit(value))) {
    append_number(out, static_cast<std::int64_t>(value));
  } else {
    append_number(out, value);
  }
}

void JsonWriter::open(char bracket) {
  out_ += bracket;
  ++depth_;
  first_ = true;
}

void JsonWriter::close(char bracket) {
  --depth_;
  if (!first_) {
    out_ += '\n';
    out_.append(static_cast<std::size_t>(depth_), ' ');
  }
  out_ += bracket;
  first_ = false;
}

void JsonWriter::next(std::string_view key) {
  out_ += first_ ? "\n" : ",\n";
  first_ = false;
  out_.append(static_cast<std::size_t>(depth_), ' ');
  if (key.empty()) return;
  out_ += nlohmann::json(key).dump() + ": ";
}

void JsonWriter::value(double number, std::string_view key) {
  if (!std::isfinite(number)) {
    throw Error(std::string(key) + ": " + number_text(number) + " cannot be written to a file");
  }
  if (number == 0.0 && std::signbit(number)) {
    out_ += "-0.0";  // JSON readers take -0 for the integer 0
  } else {
    append_exact(out_, number);
  }
}

void JsonWriter::row(const double* values, std::size_t count, std::ptrdiff_t stride, std::string_view key) {
  out_ += '[';
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) out_ += ", ";
    value(values[static_cast<std::ptrdiff_t>(i) * stride], key);
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
  out_ += nlohmann::json(value).dump();
}

void JsonWriter::boolean(std::string_view key, bool value) {
  next(key);
  out_ += value ? "true" : "false";
}

void JsonWriter::numbers(std::string_view key, const double* values, std::size_t count) {
  next(key);
  row(values, count, 1, key);
}

void JsonWriter::matrix(std::string_view key, const Eigen::Matrix<double, 3, Eigen::Dynamic>& value) {
  next(key);
  out_ += '[';
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i > 0) out_ += ", ";
    row(value.data() + i, static_cast<std::size_t>(value.cols()), 3, key);
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

void JsonWriter::begin_array(std::string_view key) {
  next(key);
  open('[');
}

void JsonWriter::begin_element() {
  next("");
  open('{');
}

std::string JsonWriter::finish() {
  close('}');
  out_ += '\n';
  return std::move(out_);
}

}  // namespace asperity

#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/progress.h"
#include "asperity/base/text.h"
#include "ply_header.h"

namespace asperity {

// The numbers after the header, one after another.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view bytes, const PlyHeader& header, const std::string& name, const Observer& observer)
      : rest_(bytes.substr(header.bytes)), order_(header.order), name_(name), watch_(observer) {}

  // `element` and `row` are where messages say they are. Throws Cancelled if the observer says so.
  void set_place(const PlyElement& element, std::size_t row) {
    watch_.next();
    element_ = &element;
    row_ = row;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(name_ + ": " + printable(element_->name) + " " + std::to_string(row_) + " (from 0): " + message);
  }

  double next(PlyType type) { return order_ ? binary(type) : ascii(type); }

  std::size_t next_count(PlyType type) {
    const double count = next(type);
    if (!(count >= 0.0)) fail("a list of " + number_text(count) + " entries");
    return static_cast<std::size_t>(count);
  }

  // Passes over `count` numbers. What a hostile count asks for ends at the end of the bytes.
  void skip(PlyType type, std::size_t count) {
    if (order_) {
      take(count, size_of(type));
    } else {
      for (std::size_t i = 0; i < count; ++i) word();
    }
  }

  std::size_t bytes_left() {
    if (!order_) rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    return rest_.size();
  }

 private:
  static constexpr std::string_view kBlank = " \t\r\n";

  const char* take(std::size_t count, std::size_t size) {
    if (count > rest_.size() / size) fail("the file is cut here");
    const char* start = rest_.data();
    rest_.remove_prefix(count * size);
    return start;
  }

  double binary(PlyType type) {
    const char* start = take(1, size_of(type));
    switch (type) {
      case PlyType::kInt8:
        return load_number<std::int8_t>(start, *order_);
      case PlyType::kUint8:
        return load_number<std::uint8_t>(start, *order_);
      case PlyType::kInt16:
        return load_number<std::int16_t>(start, *order_);
      case PlyType::kUint16:
        return load_number<std::uint16_t>(start, *order_);
      case PlyType::kInt32:
        return load_number<std::int32_t>(start, *order_);
      case PlyType::kUint32:
        return load_number<std::uint32_t>(start, *order_);
      case PlyType::kFloat32:
        return load_number<float>(start, *order_);
      case PlyType::kFloat64:
        return load_number<double>(start, *order_);
    }
    return 0.0;
  }

  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlank), rest_.size()));
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlank));
    if (word.empty()) fail("the file is cut here");
    rest_.remove_prefix(word.size());
    return word;
  }

  double ascii(PlyType type) {
    const std::string_view text = word();
    const std::optional<double> value = parse_double(text);
    if (!value) fail("'" + printable(text) + "' is not a number");
    const bool whole = type != PlyType::kFloat32 && type != PlyType::kFloat64;
    if (whole && (std::abs(*value) > 4294967295.0 || *value != std::trunc(*value))) {
      fail("'" + printable(text) + "' is not a whole number");
    }
    return *value;
  }

  std::string_view rest_;
  std::optional<std::endian> order_;
  const std::string& name_;
  const PlyElement* element_ = nullptr;
  std::size_t row_ = 0;
  RowWatch watch_;
};

}  // namespace asperity

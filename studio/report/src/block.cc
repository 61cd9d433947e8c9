#include "asperity/studio/block.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "asperity/base/error.h"

namespace asperity::studio {

static_assert(std::endian::native == std::endian::little, "blocks are little-endian");

namespace {

constexpr std::size_t kAlignment = 8;
constexpr char kMagic[] = {'A', 'S', 'B', '1'};

std::size_t aligned(std::size_t bytes) { return (bytes + kAlignment - 1) / kAlignment * kAlignment; }

void append_u32(std::string& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  char bytes[4];
  std::memcpy(bytes, &word, sizeof bytes);
  out.append(bytes, sizeof bytes);
}

}  // namespace

BlockWriter::BlockWriter(std::string_view kind) { head_["kind"] = kind; }

void BlockWriter::add(std::string_view name, std::span<const double> values, std::initializer_list<std::size_t> shape) {
  add_bytes(name, "f64", values.data(), values.size_bytes(), values.size(), shape);
}

void BlockWriter::add(std::string_view name, std::span<const float> values, std::initializer_list<std::size_t> shape) {
  add_bytes(name, "f32", values.data(), values.size_bytes(), values.size(), shape);
}

void BlockWriter::add(std::string_view name, std::span<const std::uint32_t> values,
                      std::initializer_list<std::size_t> shape) {
  add_bytes(name, "u32", values.data(), values.size_bytes(), values.size(), shape);
}

void BlockWriter::add(std::string_view name, std::span<const std::int32_t> values,
                      std::initializer_list<std::size_t> shape) {
  add_bytes(name, "i32", values.data(), values.size_bytes(), values.size(), shape);
}

void BlockWriter::add(std::string_view name, std::span<const std::uint8_t> values,
                      std::initializer_list<std::size_t> shape) {
  add_bytes(name, "u8", values.data(), values.size_bytes(), values.size(), shape);
}

void BlockWriter::add_bytes(std::string_view name, std::string_view type, const void* data, std::size_t bytes,
                            std::size_t values, std::initializer_list<std::size_t> shape) {
  Json sizes = Json::array();
  std::size_t product = 1;
  for (const std::size_t size : shape) {
    sizes.push_back(size);
    product *= size;
  }
  if (shape.size() == 0) {
    sizes.push_back(values);
    product = values;
  }
  if (product != values)
    throw Error("block array '" + std::string(name) + "': its shape does not match the number of its values");
  for (const Json& array : arrays_) {
    if (array["name"] == name) throw Error("block array '" + std::string(name) + "' is given twice");
  }
  Json described;
  described["name"] = name;
  described["type"] = type;
  described["shape"] = std::move(sizes);
  described["offset"] = data_.size();
  arrays_.push_back(std::move(described));
  if (bytes > 0) data_.append(static_cast<const char*>(data), bytes);
  data_.resize(aligned(data_.size()));
}

std::string BlockWriter::take() {
  // Offsets count from the frame's beginning, behind a head whose length depends on their digits: it is padded with
  // blanks to a length that surely holds them.
  head_["arrays"] = arrays_;
  constexpr std::size_t kLongestOffset = 20;
  const std::size_t start = aligned(8 + head_.dump_repaired().size() + kLongestOffset * arrays_.size());
  for (Json& array : head_["arrays"]) array["offset"] = array["offset"].get<std::size_t>() + start;
  std::string head = head_.dump_repaired();
  head.resize(start - 8, ' ');
  std::string out;
  out.reserve(start + data_.size());
  out.append(kMagic, sizeof kMagic);
  append_u32(out, head.size());
  out += head;
  out += data_;
  head_ = Json::object();
  arrays_ = Json::array();
  data_.clear();
  return out;
}

}  // namespace asperity::studio

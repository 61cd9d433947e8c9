#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/json/json.h"

namespace asperity::studio {

// Numbers with a head: one binary frame to the browser (docs/studio-protocol.md). A head in JSON, and arrays that it
// describes, each at a multiple of eight bytes from the frame's beginning, so that the browser views them in place.
//   u32 magic "ASB1", u32 bytes of the head, head {"kind":…,"arrays":[{"name","type","shape","offset"}],…}, arrays
// Little-endian.
class BlockWriter {
 public:
  explicit BlockWriter(std::string_view kind);

  // What the head states next to kind and arrays.
  Json& head() { return head_; }

  // `shape` is empty for a row of numbers, or its sizes, the last one running fastest; their product must be the number
  // of values. Throws Error if it is not, or if the name is taken.
  void add(std::string_view name, std::span<const double> values, std::initializer_list<std::size_t> shape = {});
  void add(std::string_view name, std::span<const float> values, std::initializer_list<std::size_t> shape = {});
  void add(std::string_view name, std::span<const std::uint32_t> values, std::initializer_list<std::size_t> shape = {});
  void add(std::string_view name, std::span<const std::int32_t> values, std::initializer_list<std::size_t> shape = {});
  void add(std::string_view name, std::span<const std::uint8_t> values, std::initializer_list<std::size_t> shape = {});

  // The frame. The writer is then empty.
  std::string take();

 private:
  void add_bytes(std::string_view name, std::string_view type, const void* data, std::size_t bytes, std::size_t values,
                 std::initializer_list<std::size_t> shape);

  Json head_;
  Json arrays_ = Json::array();
  std::string data_;
};

}  // namespace asperity::studio

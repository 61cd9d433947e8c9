#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tinygltf_config.h"

namespace asperity {

// The numbers of an accessor, its bounds checked once: every element lies in its view, every view in its buffer.
class GltfAccessor {
 public:
  // Throws Error("file: what: …") if the accessor does not exist, is sparse, leaves its buffer, or is
  // not of `components` numbers an element.
  GltfAccessor(const tinygltf::Model& model, int accessor, std::size_t components, const std::string& what);

  std::size_t size() const { return count_; }
  // A component as a number; whole numbers that stand for fractions (`normalized`) are divided.
  double number(std::size_t element, std::size_t component) const;
  // A component of an accessor of unsigned whole numbers.
  std::uint32_t index(std::size_t element) const;
  bool is_unsigned() const;

 private:
  const unsigned char* data_ = nullptr;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  std::size_t component_bytes_ = 0;
  int type_ = 0;
  bool normalized_ = false;
};

}  // namespace asperity

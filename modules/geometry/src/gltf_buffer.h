#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tinygltf_config.h"

namespace asperity {

// The one buffer of a glTF file that is being made, with its views and accessors: what is appended from a place on
// becomes an array by one of the add functions, which give its number in the file.
class GltfBuffer {
 public:
  explicit GltfBuffer(tinygltf::Model& model) : model_(model) {}

  std::size_t size() const { return bytes_.size(); }

  void append(std::string_view bytes) { bytes_ += bytes; }
  void append(std::uint32_t value);
  // As float32. Throws Error naming `what` for a value that it cannot hold.
  void append_float(double value, const char* what);

  // A view of the bytes from `begin`, padded to a multiple of four.
  int add_view(std::size_t begin, int target);
  int add_indices(std::size_t begin, std::size_t count);
  int add_floats(std::size_t begin, int type, std::size_t count);

  // Puts the bytes into the model. Throws Error if they are too many for the format.
  void close();

 private:
  int add_accessor(int view, int component, int type, std::size_t count);

  tinygltf::Model& model_;
  std::string bytes_;
};

}  // namespace asperity

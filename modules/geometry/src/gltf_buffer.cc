#include "gltf_buffer.h"

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

constexpr std::uint64_t kMaxBytes = 0xFFFFFFFFu;

}  // namespace

void GltfBuffer::append(std::uint32_t value) { append_little_endian(bytes_, value); }

void GltfBuffer::append_float(double value, const char* what) {
  const auto narrow = static_cast<float>(value);
  if (!std::isfinite(narrow))
    throw Error(std::string("glTF: ") + what + " cannot be written as float32: " + number_text(value));
  append_little_endian(bytes_, narrow);
}

int GltfBuffer::add_view(std::size_t begin, int target) {
  tinygltf::BufferView& view = model_.bufferViews.emplace_back();
  view.buffer = 0;
  view.byteOffset = begin;
  view.byteLength = bytes_.size() - begin;
  view.target = target;
  bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

int GltfBuffer::add_accessor(int view, int component, int type, std::size_t count) {
  tinygltf::Accessor& accessor = model_.accessors.emplace_back();
  accessor.bufferView = view;
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = count;
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuffer::add_indices(std::size_t begin, std::size_t count) {
  return add_accessor(add_view(begin, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                      TINYGLTF_TYPE_SCALAR, count);
}

int GltfBuffer::add_floats(std::size_t begin, int type, std::size_t count) {
  return add_accessor(add_view(begin, TINYGLTF_TARGET_ARRAY_BUFFER), TINYGLTF_COMPONENT_TYPE_FLOAT, type, count);
}

void GltfBuffer::close() {
  if (bytes_.size() >= kMaxBytes / 2) throw Error("glTF: the file would have 4 GiB or more");
  model_.buffers.emplace_back().data.assign(bytes_.begin(), bytes_.end());
}

}  // namespace asperity

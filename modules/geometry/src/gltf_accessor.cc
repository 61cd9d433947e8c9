#include "gltf_accessor.h"

#include <algorithm>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"

namespace asperity {

namespace {

std::size_t bytes_of(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

std::size_t components_of(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      return 0;
  }
}

template <class Entry>
const Entry& find_entry(const std::vector<Entry>& entries, int index, const std::string& what, const char* kind) {
  if (index < 0 || static_cast<std::size_t>(index) >= entries.size()) {
    throw Error(what + ": " + kind + " " + std::to_string(index) + " of " + std::to_string(entries.size()));
  }
  return entries[static_cast<std::size_t>(index)];
}

}  // namespace

GltfAccessor::GltfAccessor(const tinygltf::Model& model, int accessor, std::size_t components,
                           const std::string& what) {
  const tinygltf::Accessor& a = find_entry(model.accessors, accessor, what, "accessor");
  if (a.sparse.isSparse) throw Error(what + ": sparse accessors are not read");
  const tinygltf::BufferView& view = find_entry(model.bufferViews, a.bufferView, what, "buffer view");
  const tinygltf::Buffer& buffer = find_entry(model.buffers, view.buffer, what, "buffer");
  component_bytes_ = bytes_of(a.componentType);
  if (component_bytes_ == 0 || components_of(a.type) != components) {
    throw Error(what + ": an accessor of another type (component " + std::to_string(a.componentType) + ", type " +
                std::to_string(a.type) + ")");
  }
  const std::size_t element = component_bytes_ * components;
  stride_ = view.byteStride == 0 ? element : view.byteStride;
  const std::size_t size = buffer.data.size();
  const bool view_fits = view.byteOffset <= size && view.byteLength <= size - view.byteOffset;
  // (count - 1)·stride + element, without overflow.
  const bool elements_fit = view_fits && stride_ > 0 && stride_ >= element && a.count > 0 &&
                            a.byteOffset <= view.byteLength && element <= view.byteLength - a.byteOffset &&
                            a.count - 1 <= (view.byteLength - a.byteOffset - element) / stride_;
  if (!elements_fit)
    throw Error(what + ": accessor " + std::to_string(accessor) + " of " + std::to_string(a.count) +
                " elements leaves its buffer");
  data_ = buffer.data.data() + view.byteOffset + a.byteOffset;
  count_ = a.count;
  type_ = a.componentType;
  normalized_ = a.normalized;
}

double GltfAccessor::number(std::size_t element, std::size_t component) const {
  const char* at = reinterpret_cast<const char*>(data_ + element * stride_ + component * component_bytes_);
  const auto fraction = [&](double value, double full) { return normalized_ ? std::max(value / full, -1.0) : value; };
  switch (type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return fraction(load_number<std::int8_t>(at, std::endian::little), 127.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return fraction(load_number<std::uint8_t>(at, std::endian::little), 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return fraction(load_number<std::int16_t>(at, std::endian::little), 32767.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return fraction(load_number<std::uint16_t>(at, std::endian::little), 65535.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_number<std::uint32_t>(at, std::endian::little);
    default:
      return load_number<float>(at, std::endian::little);
  }
}

bool GltfAccessor::is_unsigned() const {
  return type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::uint32_t GltfAccessor::index(std::size_t element) const {
  const char* at = reinterpret_cast<const char*>(data_ + element * stride_);
  if (type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load_number<std::uint8_t>(at, std::endian::little);
  if (type_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load_number<std::uint16_t>(at, std::endian::little);
  return load_number<std::uint32_t>(at, std::endian::little);
}

}  // namespace asperity

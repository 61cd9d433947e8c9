#include "gltf_text.h"

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "asperity/base/base64.h"
#include "asperity/base/error.h"
#include "asperity/json/json.h"

namespace asperity {

namespace {

using tinygltf::Value;

constexpr std::uint32_t kGlbVersion = 2, kGlbJson = 0x4E4F534A, kGlbBinary = 0x004E4942;

// What write_gltf() puts into extras: numbers, texts, lists and objects.
Json json_of(const Value& value) {
  if (value.IsInt()) return Json(value.Get<int>());
  if (value.IsNumber()) return Json(value.Get<double>());
  if (value.IsString()) return Json(value.Get<std::string>());
  Json out = value.IsArray() ? Json::array() : Json::object();
  if (value.IsArray()) {
    for (const Value& element : value.Get<Value::Array>()) out.push_back(json_of(element));
  } else {
    for (const auto& [key, member] : value.Get<Value::Object>()) out[key] = json_of(member);
  }
  return out;
}

void add_extras(Json& out, const Value& extras) {
  if (extras.Type() != tinygltf::NULL_TYPE) out["extras"] = json_of(extras);
}

void add_extensions(Json& out, const tinygltf::ExtensionMap& extensions) {
  if (extensions.empty()) return;
  Json all = Json::object();
  for (const auto& [name, value] : extensions) all[name] = json_of(value);
  out["extensions"] = std::move(all);
}

void add_name(Json& out, const std::string& name) {
  if (!name.empty()) out["name"] = name;
}

Json json_of(const tinygltf::Accessor& accessor) {
  Json out{{"bufferView", accessor.bufferView}, {"componentType", accessor.componentType}};
  out["count"] = accessor.count;
  out["type"] = accessor.type == TINYGLTF_TYPE_SCALAR ? "SCALAR"
                : accessor.type == TINYGLTF_TYPE_VEC2 ? "VEC2"
                                                      : "VEC3";
  if (accessor.byteOffset != 0) out["byteOffset"] = accessor.byteOffset;
  if (!accessor.minValues.empty()) out["min"] = accessor.minValues;
  if (!accessor.maxValues.empty()) out["max"] = accessor.maxValues;
  return out;
}

Json json_of(const tinygltf::BufferView& view) {
  Json out{{"buffer", view.buffer}};
  out["byteLength"] = view.byteLength;
  if (view.byteOffset > 0) out["byteOffset"] = view.byteOffset;
  if (view.byteStride >= 4) out["byteStride"] = view.byteStride;
  if (view.target != 0) out["target"] = view.target;
  return out;
}

Json json_of(const tinygltf::Image& image) {
  Json out = Json::object();
  if (image.uri.empty()) {
    out["mimeType"] = image.mimeType;
    out["bufferView"] = image.bufferView;
  } else {
    out["uri"] = image.uri;
  }
  add_name(out, image.name);
  return out;
}

template <class Info>  // of a colour's or a normal map's texture
Json texture_info(const Info& info) {
  Json out{{"index", info.index}};
  if (info.texCoord != 0) out["texCoord"] = info.texCoord;
  return out;
}

Json json_of(const tinygltf::Material& material) {
  const tinygltf::PbrMetallicRoughness& surface = material.pbrMetallicRoughness;
  Json pbr{{"metallicFactor", surface.metallicFactor}};
  if (surface.baseColorFactor != std::vector<double>{1.0, 1.0, 1.0, 1.0})
    pbr["baseColorFactor"] = surface.baseColorFactor;
  if (surface.baseColorTexture.index >= 0) pbr["baseColorTexture"] = texture_info(surface.baseColorTexture);
  Json out{{"doubleSided", material.doubleSided}};
  out["pbrMetallicRoughness"] = std::move(pbr);
  if (material.normalTexture.index >= 0) out["normalTexture"] = texture_info(material.normalTexture);
  add_name(out, material.name);
  add_extras(out, material.extras);
  return out;
}

Json json_of(const tinygltf::Mesh& mesh) {
  Json primitives = Json::array();
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    Json one{{"indices", primitive.indices}, {"mode", primitive.mode}};
    one["attributes"] = Json(primitive.attributes);
    if (primitive.material >= 0) one["material"] = primitive.material;
    add_extras(one, primitive.extras);
    primitives.push_back(std::move(one));
  }
  Json out = Json::object();
  out["primitives"] = std::move(primitives);
  add_extensions(out, mesh.extensions);
  add_extras(out, mesh.extras);
  return out;
}

Json json_of(const tinygltf::Node& node) { return Json{{"mesh", node.mesh}}; }
Json json_of(const tinygltf::Texture& texture) { return Json{{"source", texture.source}}; }

template <class Part>
void add_all(Json& out, std::string_view key, const std::vector<Part>& parts) {
  if (parts.empty()) return;
  Json all = Json::array();
  for (const Part& part : parts) all.push_back(json_of(part));
  out[key] = std::move(all);
}

void append_word(std::string& out, std::size_t word) {
  if (word > std::numeric_limits<std::uint32_t>::max()) throw Error("glTF: more than 4 GiB");
  for (int k = 0; k < 4; ++k) out += static_cast<char>((word >> (8 * k)) & 0xFFU);
}

void append_chunk(std::string& out, std::uint32_t kind, std::string_view bytes, char padding) {
  const std::size_t filling = (4 - bytes.size() % 4) % 4;
  append_word(out, bytes.size() + filling);
  append_word(out, kind);
  out += bytes;
  out.append(filling, padding);
}

}  // namespace

std::string gltf_text(const tinygltf::Model& model, GltfForm form) {
  const std::vector<unsigned char>& data = model.buffers.at(0).data;
  const std::string_view bytes(reinterpret_cast<const char*>(data.data()), data.size());
  Json buffer{{"byteLength", bytes.size()}};
  if (form == GltfForm::kJson) buffer["uri"] = "data:application/octet-stream;base64," + base64(bytes);
  Json out = Json::object();
  add_all(out, "accessors", model.accessors);
  Json asset{{"generator", model.asset.generator}};
  asset["version"] = model.asset.version;
  out["asset"] = std::move(asset);
  add_all(out, "bufferViews", model.bufferViews);
  Json buffers = Json::array();
  buffers.push_back(std::move(buffer));
  out["buffers"] = std::move(buffers);
  add_extensions(out, model.extensions);
  if (!model.extensionsUsed.empty()) out["extensionsUsed"] = model.extensionsUsed;
  add_extras(out, model.extras);
  add_all(out, "images", model.images);
  add_all(out, "materials", model.materials);
  add_all(out, "meshes", model.meshes);
  add_all(out, "nodes", model.nodes);
  out["scene"] = model.defaultScene;
  Json scene = Json::object();
  scene["nodes"] = model.scenes.at(0).nodes;
  Json scenes = Json::array();
  scenes.push_back(std::move(scene));
  out["scenes"] = std::move(scenes);
  add_all(out, "textures", model.textures);
  out.sort_keys();
  if (form == GltfForm::kJson) return out.dump(2) + '\n';

  std::string chunks;
  append_chunk(chunks, kGlbJson, out.dump(), ' ');
  append_chunk(chunks, kGlbBinary, bytes, '\0');
  std::string file = "glTF";
  append_word(file, kGlbVersion);
  append_word(file, 12 + chunks.size());
  return file + chunks;
}

}  // namespace asperity

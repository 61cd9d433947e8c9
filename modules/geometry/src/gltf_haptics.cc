#include "gltf_haptics.h"

#include <cmath>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

using tinygltf::Value;

[[noreturn]] void fail_haptics(const std::string& message) { throw Error("glTF: " + message); }

Value text_value(const std::string& text) { return Value(printable(text, 1000)); }

// An item of a haptic material: an image on TEXCOORD_1 whose black and white are these values of that unit.
Value haptic_image(int texture, const char* type, double black, double white, const char* unit) {
  const Value::Object scale{{"black", Value(black)}, {"white", Value(white)}, {"unit", Value(std::string(unit))}};
  return Value(Value::Object{{"texture", Value(Value::Object{{"index", Value(texture)}, {"texCoord", Value(1)}})},
                             {"type", Value(std::string(type))},
                             {"extras", Value(Value::Object{{"asperity", Value(scale)}})}});
}

Value list_of(Value item) { return Value(Value::Array{std::move(item)}); }

}  // namespace

int add_gltf_image(tinygltf::Model& model, GltfBuffer& buffer, const GltfImage& image) {
  tinygltf::Image& out = model.images.emplace_back();
  out.name = printable(image.name, 200);
  if (image.png.empty()) {
    const auto inner = inner_path(image.file);
    if (!inner || !is_utf8(*inner))
      fail_haptics("the image '" + printable(image.file) + "' is not a file in the folder of the export");
    out.uri = *inner;
  } else {
    const std::size_t begin = buffer.size();
    buffer.append(image.png);
    out.bufferView = buffer.add_view(begin, 0);
    out.mimeType = "image/png";
  }
  model.textures.emplace_back().source = static_cast<int>(model.images.size()) - 1;
  return static_cast<int>(model.textures.size()) - 1;
}

GltfHaptics add_gltf_haptics(tinygltf::Model& model, GltfBuffer& buffer, const GltfExport& scene) {
  GltfHaptics out;
  Value::Array materials;
  int white = -1;  // the image of one white pixel
  for (const GltfTexture& texture : scene.textures) {
    if (!out.place.emplace(texture.index, out.place.size()).second)
      fail_haptics("haptic texture " + std::to_string(texture.index) + " twice");
    Value::Object extra{{"name", text_value(texture.name)}};
    Value::Object material{{"name", text_value(texture.name)}};
    out.normal_map.push_back(texture.normal_map ? add_gltf_image(model, buffer, *texture.normal_map) : -1);
    const auto checked = [&](const char* key, double value) {
      if (!std::isfinite(value))
        fail_haptics(std::string(key) + " of haptic texture " + std::to_string(texture.index) + " is not finite");
      return value;
    };
    if (texture.height_range_m) {
      extra.emplace("height_range_m", Value(checked("height_range_m", *texture.height_range_m)));
      extra.emplace("height_low_m", Value(checked("height_low_m", texture.height_low_m)));
    }
    if (texture.height_map) {
      const int height = add_gltf_image(model, buffer, *texture.height_map);
      extra.emplace("height_map", Value(height));
      material.emplace("vibrotactileTexture",
                       list_of(haptic_image(height, "High_Resolution", texture.height_low_m,
                                            texture.height_low_m + texture.height_range_m.value_or(1.0),
                                            texture.height_range_m ? "m" : "unknown")));
    }
    const auto coefficient = [&](const char* key, const char* list, const char* unit, std::optional<double> value) {
      if (!value) return;
      extra.emplace(key, Value(checked(key, *value)));
      if (scene.white_png.empty()) return;
      if (white < 0) white = add_gltf_image(model, buffer, {"one white pixel", scene.white_png, {}});
      material.emplace(list, list_of(haptic_image(white, "Low_Resolution", 0.0, *value, unit)));
    };
    coefficient("stiffness_N_per_m", "stiffness", "N/m", texture.stiffness_N_per_m);
    coefficient("friction", "friction", "1", texture.friction);
    if (!texture.warning.empty()) extra.emplace("warning", text_value(texture.warning));
    material.emplace("extras", Value(Value::Object{{"asperity", Value(extra)}}));
    materials.emplace_back(std::move(material));
    out.extra.push_back(std::move(extra));
  }
  if (materials.empty()) return out;
  model.extensions.emplace(kMpegHapticMaterial, Value(Value::Object{{"materials", Value(std::move(materials))}}));
  model.extensionsUsed.emplace_back(kMpegHapticMaterial);
  return out;
}

}  // namespace asperity

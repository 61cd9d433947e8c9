#include "gltf_document.h"

#include <algorithm>
#include <array>

#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace {

constexpr std::size_t kMaxDepth = 32;
constexpr std::size_t kMaxValues = 20'000'000;
constexpr std::size_t kMaxBuffers = 256;
constexpr std::size_t kMaxJsonBytes = std::size_t{512} << 20;
constexpr std::array<std::string_view, 3> kKnownExtensions{"KHR_mesh_quantization", "KHR_materials_unlit",
                                                           "KHR_texture_transform"};

class Checker {
 public:
  Checker(std::string_view bytes, const std::string& name, const MeshLimits& limits, const Observer& observer)
      : bytes_(bytes), name_(name), limits_(limits), observer_(observer) {}

  GltfDocument check() {
    parse(split());
    version();
    extensions();
    buffers();
    images();
    for (const char* left_out : {"animations", "cameras", "skins"}) {
      const Json& array = member(left_out);
      if (array.is_array() && !array.empty()) {
        out_.problems.push_back({left_out, name_ + ": " + left_out + " are left out", array.size()});
      }
    }
    for (const char* unused : {"animations", "cameras", "skins", "images", "samplers", "extensions", "extensionsUsed",
                               "extensionsRequired", "extras"}) {
      document_.erase(unused);
    }
    // tinygltf counts a JSON text in 32 bits.
    out_.json = document_.dump();
    if (out_.json.size() > kMaxJsonBytes) fail("its JSON is too large");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Error(name_ + ": " + message); }

  const Json& member(const char* key) const {
    static const Json nothing;
    const Json* found = document_.find(key);
    return found == nullptr ? nothing : *found;
  }

  std::uint32_t word(std::size_t at) const {
    return load_number<std::uint32_t>(bytes_.data() + at, std::endian::little);
  }

  // The JSON text; the binary chunk of a .glb is kept aside.
  std::string_view split() {
    if (!bytes_.starts_with("glTF")) return bytes_;
    if (bytes_.size() < 20) fail("is cut: a binary glTF of " + std::to_string(bytes_.size()) + " bytes");
    if (word(4) != 2) fail("is glTF version " + std::to_string(word(4)) + "; 2 is read");
    if (word(8) > bytes_.size())
      fail("is cut: its header states " + std::to_string(word(8)) + " bytes, it has " + std::to_string(bytes_.size()));
    constexpr std::uint32_t kJson = 0x4E4F534A;
    constexpr std::uint32_t kBinary = 0x004E4942;
    std::string_view text;
    std::size_t at = 12;
    while (bytes_.size() - at >= 8) {
      const std::size_t length = word(at);
      const std::uint32_t kind = word(at + 4);
      at += 8;
      if (length > bytes_.size() - at) fail("is cut inside a chunk of " + std::to_string(length) + " bytes");
      if (kind == kJson && text.empty()) text = bytes_.substr(at, length);
      if (kind == kBinary && out_.binary.empty()) out_.binary = bytes_.substr(at, length);
      at += length;
    }
    if (text.empty()) fail("has no JSON chunk");
    return text;
  }

  void parse(std::string_view text) {
    JsonLimits limits;
    limits.bytes = kMaxJsonBytes;
    limits.depth = kMaxDepth;
    limits.values = kMaxValues;
    document_ = parse_json(text, name_, limits, observer_.without_progress());
    if (!document_.is_object()) fail("is not glTF: its JSON is not an object");
  }

  void version() const {
    const Json& asset = member("asset");
    const Json* found = asset.find("version");
    const std::string version = found != nullptr && found->is_string() ? found->text() : "";
    if (!version.starts_with("2.")) fail("is glTF of version '" + printable(version) + "'; 2.0 is read");
  }

  void extensions() {
    const Json& required = member("extensionsRequired");
    if (required.is_array()) {
      for (const Json& extension : required) {
        if (!is_known(extension)) fail("needs the extension '" + shown(extension) + "', which is not read");
      }
    }
    const Json& used = member("extensionsUsed");
    std::size_t count = 0;
    std::string first;
    if (used.is_array()) {
      for (const Json& extension : used) {
        if (extension.is_string() && extension.text() == "KHR_mesh_quantization") continue;
        if (count++ == 0) first = shown(extension);
      }
    }
    if (count > 0) out_.problems.push_back({"extension", name_ + ": the extension '" + first + "' is not read", count});
  }

  static bool is_known(const Json& extension) {
    return extension.is_string() &&
           std::find(kKnownExtensions.begin(), kKnownExtensions.end(), extension.text()) != kKnownExtensions.end();
  }

  static std::string shown(const Json& text) { return text.is_string() ? printable(text.text()) : "?"; }

  void buffers() {
    Json* buffers = document_.find("buffers");
    if (buffers == nullptr) return;
    if (!buffers->is_array() || buffers->size() > kMaxBuffers)
      fail("'buffers' is not a list of at most " + std::to_string(kMaxBuffers));
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < buffers->size(); ++i) {
      Json& buffer = (*buffers)[i];
      const Json* length = buffer.find("byteLength");
      if (length == nullptr || !length->is_number_unsigned() || length->get<std::uint64_t>() == 0) {
        fail("buffer " + std::to_string(i) + " has no length");
      }
      const auto size = length->get<std::uint64_t>();
      if (size > limits_.file_bytes - total)
        fail("its buffers are larger than " + std::to_string(limits_.file_bytes) + " bytes");
      total += size;
      if (buffer.contains("uri")) continue;
      if (i != 0 || size > out_.binary.size()) {
        fail("buffer " + std::to_string(i) + " of " + std::to_string(size) + " bytes is not in the file");
      }
      out_.binary = out_.binary.substr(0, size);
      buffer["uri"] = kBinaryChunk;
    }
  }

  void images() {
    const Json& images = member("images");
    if (!images.is_array()) return;
    std::size_t embedded = 0;
    std::size_t outside = 0;
    for (const Json& image : images) {
      std::string& file = out_.image_files.emplace_back();
      const Json* uri = image.find("uri");
      const bool is_file = uri != nullptr && uri->is_string() && !uri->text().starts_with("data:");
      if (!is_file) {
        ++embedded;
      } else if (const auto inner = inner_path(uri->text())) {
        file = *inner;
      } else {
        ++outside;
      }
    }
    if (embedded > 0)
      out_.problems.push_back({"embedded_image", name_ + ": images inside the file are left out", embedded});
    if (outside > 0)
      out_.problems.push_back({"outside_path", name_ + ": an image's file is outside the folder", outside});
  }

  std::string_view bytes_;
  const std::string& name_;
  const MeshLimits& limits_;
  const Observer& observer_;
  Json document_;
  GltfDocument out_;
};

}  // namespace

GltfDocument check_gltf(std::string_view bytes, const std::string& name, const MeshLimits& limits,
                        const Observer& observer) {
  return Checker(bytes, name, limits, observer).check();
}

}  // namespace asperity

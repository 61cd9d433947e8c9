#include <algorithm>
#include <cmath>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/texture/texture_file.h"
#include "model_block.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestTextureFile_bytes = 16ULL << 20;
constexpr std::uint64_t kLargestPayload_bytes = 256ULL << 20;
constexpr std::size_t kMostRoughnessValues = 100;

std::optional<double> optional_number(JsonObject& in, const char* key, Range range) {
  const auto value = in.optional(key);
  return value ? std::optional(value->number(range)) : std::nullopt;
}

// Reads the block of the model that is called as its key.
void read_model(const BlockInput& input, TextureModel& model) {
  for_each_texture_model([&]<class Model>() {
    using Traits = TextureModelTraits<Model>;
    if (input.path == Traits::kName) Traits::read_block(input, model.emplace<Model>());
  });
}

void parse_model(JsonObject& root, const PayloadReader& payload, Texture& texture) {
  const JsonItem item = root.required("model");
  const std::string& model = item.text(kLongestText_bytes);
  std::string known;
  for (const auto name : kTextureModelNames) {
    if (model == name) {
      JsonObject block = root.required_object(model);
      return read_model({block, model, payload}, texture.model);
    }
    known.append(known.empty() ? "" : ", ").append(name);
  }
  item.fail("'" + printable(model) + "' is not a model that this version knows (" + known + ")");
}

void take_fit(Texture& texture) {
  const std::vector<JsonMember>& members = texture.extra.items();
  const auto found = std::find_if(members.begin(), members.end(), [](const auto& each) { return each.key == kFitKey; });
  if (found == members.end()) return;
  texture.fit = {found->value, static_cast<std::size_t>(found - members.begin())};
  texture.extra.erase(kFitKey);
}

void parse_common(JsonObject& root, Texture& texture) {
  root.read_text("name", texture.name, kLongestText_bytes);
  texture.compliance_kc = optional_number(root, "compliance_kc", {0.0, 1.0});
  texture.stiffness_N_per_m = optional_number(root, "stiffness_N_per_m", {0.0, 1e9});
  texture.friction = optional_number(root, "friction", {0.0, 100.0});
  texture.static_friction_ratio = optional_number(root, "static_friction_ratio", {1.0, 100.0});
  texture.height_offset_m = optional_number(root, "lift_m", {-1e6, 1e6});
  texture.height_sigma_m = optional_number(root, "height_sigma_m", {0.0, 1e6});
  if (auto roughness = root.optional_object("roughness")) {
    const auto& values = roughness->item().json().items();
    if (values.size() > kMostRoughnessValues)
      roughness->item().fail("has more than " + std::to_string(kMostRoughnessValues) + " values");
    for (const auto& member : values) texture.roughness[member.key] = roughness->required(member.key).number();
  }
  if (const auto band = root.optional("band_cycles_per_mm")) {
    const auto limits = band->numbers(kMostCoefficients);
    constexpr double kShortestWave_cycles_per_mm = 1e7;  // an atom
    if (limits.size() != 2 || !(limits[0] >= 0.0) || !(limits[1] >= limits[0]) ||
        limits[1] > kShortestWave_cycles_per_mm) {
      band->fail("is not [low, high] with 0 <= low <= high <= 1e7");
    }
    texture.band_cycles_per_mm = {limits[0], limits[1]};
  }
  if (auto source = root.optional_object("source")) {
    source->read_text("recording", texture.source.recording, kLongestText_bytes);
    source->read_text("version", texture.source.version, kLongestText_bytes);
    if (const Json* config = source->find("config")) texture.source.config = *config;
    texture.source.snr = optional_number(*source, "snr", {0.0, 1e30});
    source->finish();
  }
  texture.extra = root.extra();
  take_fit(texture);
}

}  // namespace

std::string BlockInput::read_payload(const char* ending) const {
  const JsonItem item = block.required("file");
  const std::string& file = item.text(kLongestText_bytes);
  const bool plain = !file.empty() && file.front() != '.' && file.find_first_of("/\\:") == std::string::npos &&
                     file.find('\0') == std::string::npos;
  if (!plain || !file.ends_with(ending)) {
    item.fail("'" + printable(file) + "' is not the plain name of a file *" + ending + " in the same folder");
  }
  if (!payload) item.fail("'" + printable(file) + "' cannot be read from text alone");
  return payload(file);
}

Texture parse_texture(std::string_view content, const std::string& name, const PayloadReader& payload,
                      const Observer& observer) {
  const Json json = parse_json(content, name, {}, observer.without_progress());
  JsonObject root(json, name);
  root.require_format("asperity-texture");
  Texture texture;
  parse_model(root, payload, texture);
  parse_common(root, texture);
  root.finish();
  return texture;
}

Texture read_texture(const std::filesystem::path& path, const std::function<void(std::string_view)>& seen,
                     const Observer& observer) {
  const auto read = [&](const std::filesystem::path& file, std::uint64_t limit_bytes) {
    std::string content = read_file(file, limit_bytes);
    if (seen) seen(content);
    return content;
  };
  const PayloadReader payload = [&](const std::string& file) {
    const auto payload_path = path.parent_path() / file;
    // A link could lead out of the folder.
    if (std::filesystem::is_symlink(payload_path)) throw Error(payload_path.string() + ": is a symbolic link");
    return read(payload_path, kLargestPayload_bytes);
  };
  return parse_texture(read(path, kLargestTextureFile_bytes), path.string(), payload, observer);
}

}  // namespace asperity

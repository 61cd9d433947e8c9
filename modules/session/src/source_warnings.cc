#include "source_warnings.h"

#include <map>
#include <optional>
#include <string>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLargestResult_bytes = std::uint64_t{64} << 20;

std::string result_text(const Json& json, const char* key) {
  const Json* found = json.is_object() ? json.find(key) : nullptr;
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

// "invalid: …" of a result; empty if it is valid.
std::string result_warning(const Json& result) {
  const std::string verdict = result_text(result, "verdict");
  const Json* trustworthy = result.is_object() ? result.find("trustworthy") : nullptr;
  if (trustworthy != nullptr && *trustworthy == Json(false)) return verdict.empty() ? "invalid" : verdict;
  return verdict == "valid" ? "" : verdict;
}

// The same of a scan of registration.json, of its verdicts of the worst severity.
std::string scan_warning(const Json& scan) {
  const std::string word = result_text(scan, "verdict");
  if (word.empty() || word == "valid") return {};
  std::string out = word;
  const Json* verdicts = scan.find("verdicts");
  if (verdicts == nullptr || !verdicts->is_array()) return out;
  const char* separator = ": ";
  for (const Json& verdict : *verdicts) {
    if (result_text(verdict, "severity") != word) continue;
    out += separator + result_text(verdict, "message");
    separator = ". ";
  }
  return out;
}

std::map<int, std::string> scan_warnings(const Json& registration) {
  std::map<int, std::string> out;
  const Json* scans = registration.is_object() ? registration.find("scans") : nullptr;
  if (scans == nullptr || !scans->is_array()) return out;
  for (const Json& scan : *scans) {
    const Json* index = scan.is_object() ? scan.find("texture") : nullptr;
    if (index != nullptr && index->is_number()) out[index->get<int>()] = scan_warning(scan);
  }
  return out;
}

}  // namespace

void add_source_warnings(const fs::path& folder, Scene& scene) {
  const auto each = [&scene](const auto& warn) {
    for (SceneObject& object : scene.objects)
      for (SceneTexture& texture : object.textures) warn(object, texture);
  };
  for (const char* name : {"registration.json", "result.json", "area.json"}) {
    const fs::path file = folder / name;
    std::error_code none;
    if (!fs::is_regular_file(file, none)) continue;
    std::optional<Json> result;
    try {
      result = parse_json(read_file(file, kLargestResult_bytes), printable(file.string(), 200));
    } catch (const Error& error) {
      each([&](SceneObject&, SceneTexture& texture) {
        texture.warning = "the validity of its source is not known: " + std::string(error.what());
      });
      return;
    }
    if (std::string_view(name) != "registration.json") {
      const std::string warning = result_warning(*result);
      each([&](SceneObject&, SceneTexture& texture) { texture.warning = warning; });
      return;
    }
    const auto warnings = scan_warnings(*result);
    each([&](SceneObject& object, SceneTexture& texture) {
      if (&object != &scene.objects.front()) return;  // only the first object is registered
      if (texture.origin && !texture.origin->kind.empty() && !texture.origin->is_scan()) return;
      const auto found = warnings.find(texture.index);
      if (found != warnings.end()) texture.warning = found->second;
    });
    return;
  }
}

}  // namespace asperity

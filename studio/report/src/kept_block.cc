#include "kept_block.h"

#include <cstdint>
#include <cstring>
#include <string_view>

#include "asperity/base/base64.h"
#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/json/parse_json.h"

namespace asperity::studio {

namespace {

constexpr std::uint64_t kLargestReport_bytes = 64U << 20U;
constexpr std::size_t kLargestHead_bytes = 16U << 20U;
constexpr std::size_t kDeepestHead = 34;  // a result.json, and its nesting
constexpr std::string_view kBegin = "<script type=\"application/octet-stream\"";
constexpr std::string_view kEnd = "</script>";

// The head of a block "measured"; null for anything else.
Json head_of(const std::string& block) {
  std::uint32_t bytes = 0;
  if (block.size() < 8 || !block.starts_with("ASB1")) return nullptr;
  std::memcpy(&bytes, block.data() + 4, sizeof bytes);
  if (bytes > block.size() - 8 || bytes > kLargestHead_bytes) return nullptr;
  JsonLimits limits;
  limits.bytes = kLargestHead_bytes;
  limits.depth = kDeepestHead;
  Json head = parse_json_or_null(std::string_view(block).substr(8, bytes), limits);
  const Json* kind = head.find("kind");
  return kind != nullptr && *kind == "measured" ? head : Json(nullptr);
}

}  // namespace

std::optional<std::string> kept_block(const std::filesystem::path& report, const Json& result) {
  if (!std::filesystem::is_regular_file(report)) return std::nullopt;
  std::string page;
  try {
    page = read_file(report, kLargestReport_bytes);
  } catch (const Error&) {
    return std::nullopt;
  }
  // Each search continues where the last one ended, so that the page is read once.
  std::size_t end = 0;
  for (std::size_t at = page.find(kBegin); at != std::string::npos; at = page.find(kBegin, end)) {
    const std::size_t begin = page.find('>', at);
    end = page.find(kEnd, at);
    if (begin == std::string::npos || end == std::string::npos || begin > end) return std::nullopt;
    const auto block = bytes_of_base64(std::string_view(page).substr(begin + 1, end - begin - 1));
    const Json head = block ? head_of(*block) : Json(nullptr);
    if (head.is_object() && head.contains("result") && head["result"] == result) return block;
  }
  return std::nullopt;
}

std::vector<double> block_numbers(const std::string& block, std::string_view array) {
  const Json head = head_of(block);
  const Json* arrays = head.is_object() ? head.find("arrays") : nullptr;
  if (arrays == nullptr || !arrays->is_array()) return {};
  for (const Json& one : *arrays) {
    if (!one.is_object()) return {};
    const Json *name = one.find("name"), *type = one.find("type"), *shape = one.find("shape"), *at = one.find("offset");
    if (name == nullptr || !(*name == std::string(array)) || type == nullptr || !(*type == "f64")) continue;
    if (shape == nullptr || !shape->is_array() || shape->size() != 1 || at == nullptr || !at->is_number()) return {};
    const double count = shape->begin()->is_number() ? shape->begin()->get<double>() : -1.0;
    const double offset = at->get<double>();
    if (!(count >= 0.0) || !(offset >= 0.0) || offset + 8.0 * count > static_cast<double>(block.size())) return {};
    std::vector<double> out(static_cast<std::size_t>(count));
    if (!out.empty()) std::memcpy(out.data(), block.data() + static_cast<std::size_t>(offset), 8 * out.size());
    return out;
  }
  return {};
}

}  // namespace asperity::studio

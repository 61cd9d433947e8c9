#include "asperity/texture/import_penn.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <pugixml.hpp>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/texture/series_state.h"

namespace asperity {
namespace {

constexpr std::uint64_t kLargestFile_bytes = 8ULL << 20;
constexpr int kDeepest = 16;

std::size_t line_at(std::string_view text, std::size_t offset) {
  return 1 + static_cast<std::size_t>(std::count(
                 text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n'));
}

// Before anything is built from it: no declared entities, no deep nesting. Goes over the text once; a quoted value of
// an attribute may hold what ends a tag elsewhere.
class ShapeCheck {
 public:
  ShapeCheck(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void check() {
    for (at_ = text_.find('<'); at_ != std::string_view::npos; at_ = text_.find('<', at_)) {
      if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>")) continue;
      if (starts_with("<!")) fail("a document type declaration is not accepted");
      if (skip("</", ">")) {
        --depth_;
      } else if (!skip_tag() && ++depth_ > kDeepest) {
        fail("nested deeper than " + std::to_string(kDeepest));
      }
    }
  }

 private:
  bool starts_with(std::string_view open) const { return text_.compare(at_, open.size(), open) == 0; }

  bool skip(std::string_view open, std::string_view close) {
    if (!starts_with(open)) return false;
    const auto end = text_.find(close, at_ + open.size());
    if (end == std::string_view::npos) fail("'" + std::string(open) + "' is not closed");
    at_ = end + close.size();
    return true;
  }
  // True if the tag has no content.
  bool skip_tag() {
    char quote = '\0';
    for (std::size_t i = at_ + 1; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        at_ = i + 1;
        return text_[i - 1] == '/';
      }
    }
    fail("a tag is not closed");
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(name_ + ":" + std::to_string(line_at(text_, at_)) + ": " + message);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& message) const {
    const auto offset = node.offset_debug();
    throw Error(name_ + ":" + std::to_string(line_at(text_, offset > 0 ? static_cast<std::size_t>(offset) : 0)) +
                ": '" + printable(node.name()) + "' " + message);
  }

  pugi::xml_node only(const pugi::xml_node& parent, const char* key) const {
    const auto node = parent.child(key);
    if (node && node.next_sibling(key)) fail(node.next_sibling(key), "appears twice");
    return node;
  }
  pugi::xml_node require(const pugi::xml_node& parent, const char* key) const {
    const auto node = only(parent, key);
    if (!node) fail(parent, std::string("has no '") + key + "'");
    return node;
  }

  double number(const pugi::xml_node& node, std::string_view text, double low, double high) const {
    const auto value = parse_double(trim(text));
    if (!value || !std::isfinite(*value)) fail(node, "holds '" + printable(text) + "', which is not a number");
    if (*value < low || *value > high)
      fail(node,
           "holds " + number_text(*value) + ", which is not within " + number_text(low) + " and " + number_text(high));
    return *value;
  }
  // The number that an element holds, itself or in its one <value>.
  double value(const pugi::xml_node& node, double low, double high) const {
    const auto all = values(node, 1, low, high);
    if (all.size() != 1) fail(node, "holds " + std::to_string(all.size()) + " numbers where one is expected");
    return all[0];
  }
  int count(const pugi::xml_node& node, int high) const {
    const double n = value(node, 0.0, high);
    if (n != std::floor(n)) fail(node, "holds " + number_text(n) + ", which is not a count");
    return static_cast<int>(n);
  }

  // The numbers of the <value> elements; without any, of the text.
  std::vector<double> values(const pugi::xml_node& node, std::size_t most, double low, double high) const {
    std::vector<double> numbers;
    const auto add = [&](std::string_view text) {
      if (numbers.size() == most) fail(node, "holds more than " + std::to_string(most) + " numbers");
      numbers.push_back(number(node, text, low, high));
    };
    if (node.child("value")) {
      for (const auto& item : node.children("value")) add(item.child_value());
      return numbers;
    }
    std::string_view text = node.child_value();
    constexpr std::string_view kBlanks = " \t\r\n,;";
    while (true) {
      const auto from = text.find_first_not_of(kBlanks);
      if (from == std::string_view::npos) return numbers;
      const auto to = std::min(text.find_first_of(kBlanks, from), text.size());
      add(text.substr(from, to - from));
      text.remove_prefix(to);
    }
  }

 private:
  std::string_view text_;
  const std::string& name_;
};

constexpr double kLargest = 1e12;
constexpr double kLargestSpeed_mmps = 1e6;
constexpr double kLargestForce_N = 1e6;

AutoregressiveModel read_model(const Reader& reader, const pugi::xml_node& node) {
  AutoregressiveModel model;
  const auto most = static_cast<std::size_t>(kMaxSeriesOrder);
  model.ar_lsf_rad = reader.values(reader.require(node, "ARlsf"), most, 0.0, 4.0);
  if (const auto ma = reader.only(node, "MAlsf")) model.ma_lsf_rad = reader.values(ma, most, 0.0, 4.0);
  // Without a numerator the toolkit does not look at the gain.
  if (!model.ma_lsf_rad.empty()) model.gain = reader.value(reader.require(node, "gain"), -1e6, 1e6);
  model.variance = reader.value(reader.require(node, "var"), 0.0, kLargest);
  model.speed_mps = 1e-3 * reader.value(reader.require(node, "speedMod"), 0.0, kLargestSpeed_mmps);
  model.force_N = reader.value(reader.require(node, "forceMod"), 0.0, kLargestForce_N);
  return model;
}

void check_list(const Reader& reader, const pugi::xml_node& set, const char* key, double scale,
                double AutoregressiveModel::*member, const std::vector<AutoregressiveModel>& models) {
  const auto node = reader.only(set, key);
  if (!node) return;
  const auto list = reader.values(node, static_cast<std::size_t>(kMaxSeriesModels), 0.0, kLargest);
  if (list.size() != models.size())
    reader.fail(node, "has " + std::to_string(list.size()) + " values where there are " +
                          std::to_string(models.size()) + " models");
  for (std::size_t i = 0; i < list.size(); ++i) {
    // The lists are printed with fewer digits in some files.
    if (std::abs(scale * list[i] - models[i].*member) > 1e-3 * std::abs(models[i].*member) + 1e-6)
      reader.fail(node, "value " + std::to_string(i + 1) + " is " + number_text(list[i]) + ", that of the model is " +
                            number_text(models[i].*member / scale));
  }
}

void check_order(const Reader& reader, const pugi::xml_node& set, const char* key, std::size_t order) {
  const auto node = reader.only(set, key);
  if (node && static_cast<std::size_t>(reader.count(node, 1000)) != order)
    reader.fail(node, "is " + printable(node.child_value()) + " where the models have " + std::to_string(order));
}

void read_triangles(const Reader& reader, const pugi::xml_node& set, PennTexture& penn) {
  auto& triangles = penn.texture.triangles;
  const int models = static_cast<int>(penn.texture.models.size());
  bool fit = true;
  for (const auto& node : set.children("tri")) {
    if (triangles.size() == static_cast<std::size_t>(kMaxSeriesTriangles))
      reader.fail(node, "comes more than " + std::to_string(kMaxSeriesTriangles) + " times");
    const auto indices = reader.values(node, 3, 0.0, 1e6);
    if (indices.size() != 3)
      reader.fail(node, "has " + std::to_string(indices.size()) + " values where 3 are expected");
    std::array<int, 3> triangle;
    for (std::size_t j = 0; j < 3; ++j) {
      triangle[j] = static_cast<int>(indices[j]) - 1;
      if (indices[j] != std::floor(indices[j])) reader.fail(node, "holds " + number_text(indices[j]) + ", no index");
      fit = fit && triangle[j] >= 0 && triangle[j] < models;
    }
    triangles.push_back(triangle);
  }
  if (const auto node = reader.only(set, "numTri")) {
    const int count = reader.count(node, 1'000'000);
    if (count != static_cast<int>(triangles.size()))
      reader.fail(
          node, "is " + std::to_string(count) + " where there are " + std::to_string(triangles.size()) + " triangles");
  }
  if (!fit) {
    penn.problems.push_back(
        {"triangles_replaced", "triangles name models that are not there: the file's triangulation was replaced", 1});
    triangles.clear();
  }
}

}  // namespace

PennTexture parse_penn(std::string_view text, const std::string& name, const ImportPennConfig& config) {
  if (text.size() > kLargestFile_bytes)
    throw Error(name + ": " + std::to_string(text.size()) + " bytes, more than " + std::to_string(kLargestFile_bytes));
  ShapeCheck(text, name).check();
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
  if (!result) {
    throw Error(name + ":" +
                std::to_string(line_at(text, static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)))) +
                ": not XML: " + result.description());
  }
  const Reader reader(text, name);
  const auto set = document.child("modelSet");
  if (!set) throw Error(name + ":1: has no 'modelSet': not a texture of the Penn Haptic Texture Toolkit");

  PennTexture penn;
  penn.texture.rate_Hz = config.rate_Hz;
  penn.texture.mass_kg = config.mass_kg;
  penn.texture.offset_sigmas = config.offset_sigmas;
  // Below these the toolkit takes speed and force as none.
  penn.texture.fade_speed_mps = 5e-5;
  penn.texture.fade_force_N = 0.05;
  if (const auto mu = reader.only(set, "mu")) penn.friction = reader.value(mu, 0.0, 100.0);
  penn.texture.max_speed_mps = 1e-3 * reader.value(reader.require(set, "maxSpeed"), 0.0, kLargestSpeed_mmps);
  penn.texture.max_force_N = reader.value(reader.require(set, "maxForce"), 0.0, kLargestForce_N);
  for (const auto& node : set.children("model")) {
    if (penn.texture.models.size() == static_cast<std::size_t>(kMaxSeriesModels))
      reader.fail(node, "comes more than " + std::to_string(kMaxSeriesModels) + " times");
    penn.texture.models.push_back(read_model(reader, node));
  }
  if (penn.texture.models.empty()) reader.fail(set, "has no 'model'");
  if (const auto node = reader.only(set, "numMod")) {
    const int count = reader.count(node, 1'000'000);
    if (count != static_cast<int>(penn.texture.models.size()))
      reader.fail(node, "is " + std::to_string(count) + " where there are " +
                            std::to_string(penn.texture.models.size()) + " models");
  }
  check_list(reader, set, "speedList", 1e-3, &AutoregressiveModel::speed_mps, penn.texture.models);
  check_list(reader, set, "forceList", 1.0, &AutoregressiveModel::force_N, penn.texture.models);
  check_order(reader, set, "numARCoeff", penn.texture.models.front().ar_lsf_rad.size());
  check_order(reader, set, "numMACoeff", penn.texture.models.front().ma_lsf_rad.size());
  read_triangles(reader, set, penn);
  prepare_autoregressive(penn.texture, name);
  return penn;
}

PennTexture import_penn(const std::filesystem::path& path, const ImportPennConfig& config) {
  return parse_penn(read_file(path, kLargestFile_bytes), path.string(), config);
}

}  // namespace asperity

#include "asperity/tracking/aruco_dictionary.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <optional>
#include <set>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/vision/predefined_dictionary.h"

namespace asperity {

namespace {

constexpr std::uint64_t kLargestFile_bytes = 1 << 20;
constexpr int kMostMarkers = 2000;
constexpr int kMostBits = 16;
using Cells = std::bitset<kMostBits * kMostBits>;

// The cells of `marker` after a quarter turn against the clock.
std::vector<std::uint8_t> turned(const std::vector<std::uint8_t>& marker, int bits) {
  std::vector<std::uint8_t> out;
  out.reserve(marker.size());
  for (int row = 0; row < bits; ++row) {
    for (int column = 0; column < bits; ++column) {
      out.push_back(marker[static_cast<std::size_t>(column * bits + bits - 1 - row)]);
    }
  }
  return out;
}

Cells cells_of(const std::vector<std::uint8_t>& marker) {
  Cells out;
  for (std::size_t i = 0; i < marker.size(); ++i) out[i] = marker[i] != 0;
  return out;
}

// The least count of differing cells of two markers in any turn, and of one and itself turned.
int least_distance(const ArucoDictionary& dictionary, const std::string& name) {
  std::vector<std::array<Cells, 4>> all;
  all.reserve(dictionary.markers.size());
  for (std::vector<std::uint8_t> marker : dictionary.markers) {
    auto& turns = all.emplace_back();
    for (Cells& turn : turns) {
      turn = cells_of(marker);
      marker = turned(marker, dictionary.bits);
    }
  }
  std::size_t least = static_cast<std::size_t>(dictionary.bits * dictionary.bits);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 1; k < 4; ++k) least = std::min(least, (all[i][0] ^ all[i][k]).count());
    if (least == 0) throw Error(name + ": marker_" + std::to_string(i) + " looks the same after a rotation");
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < 4; ++k) least = std::min(least, (all[i][0] ^ all[j][k]).count());
      if (least == 0) {
        throw Error(name + ": marker_" + std::to_string(j) + " and marker_" + std::to_string(i) + " look the same");
      }
    }
  }
  return static_cast<int>(least);
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  ArucoDictionary parse() {
    if (!is_utf8(rest_)) throw Error(name_ + ": is not text in UTF-8");
    while (!rest_.empty()) take_line();
    if (!count_) throw Error(name_ + ": nmarkers is missing");
    if (!bits_) throw Error(name_ + ": markersize is missing");
    ArucoDictionary out;
    out.bits = *bits_;
    out.markers.resize(static_cast<std::size_t>(*count_));
    for (const auto& [id, line, cells] : markers_) set_marker(out, id, line, cells);
    for (std::size_t id = 0; id < out.markers.size(); ++id) {
      if (out.markers[id].empty()) throw Error(name_ + ": marker_" + std::to_string(id) + " is missing");
    }
    const int least = least_distance(out, name_);
    out.correctable_bits = correctable_ ? *correctable_ : (least - 1) / 2;
    return out;
  }

 private:
  struct MarkerLine {
    int id;
    std::size_t line;
    std::string_view cells;
  };

  void take_line() {
    ++line_;
    const auto end = rest_.find('\n');
    const std::string_view line = trim(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (line.empty() || line.front() == '#' || line.front() == '%' || line == "---" || line == "...") return;
    const auto colon = line.find(':');
    if (colon == std::string_view::npos) fail(line_, "'" + printable(line) + "' is not KEY: VALUE");
    const std::string_view key = trim(line.substr(0, colon));
    std::string_view value = trim(line.substr(colon + 1));
    if (!seen_.insert(key).second) fail(line_, "'" + printable(key) + "' is given twice");
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
    if (key == "nmarkers") {
      count_ = number(key, value, 1, kMostMarkers);
    } else if (key == "markersize") {
      bits_ = number(key, value, 2, kMostBits);
    } else if (key == "maxCorrectionBits") {
      correctable_ = number(key, value, 0, kMostBits * kMostBits);
    } else if (key.starts_with("marker_")) {
      markers_.push_back({number(key, key.substr(7), 0, kMostMarkers - 1), line_, value});
    } else {
      fail(line_,
           "unknown key '" + printable(key) + "'; there are nmarkers, markersize, maxCorrectionBits and marker_0 …");
    }
  }

  void set_marker(ArucoDictionary& out, int id, std::size_t line, std::string_view cells) const {
    const std::string key = "marker_" + std::to_string(id);
    if (id >= *count_) fail(line, key + " is beyond nmarkers, " + std::to_string(*count_));
    auto& marker = out.markers[static_cast<std::size_t>(id)];
    if (!marker.empty()) fail(line, key + " is given twice");
    const auto expected = static_cast<std::size_t>(out.bits * out.bits);
    if (cells.size() != expected || cells.find_first_not_of("01") != std::string_view::npos) {
      fail(line, key + ": '" + printable(cells) + "' is not " + std::to_string(expected) + " times 0 or 1");
    }
    marker.reserve(expected);
    for (const char cell : cells) marker.push_back(cell == '1' ? 1 : 0);
  }

  int number(std::string_view key, std::string_view text, int low, int high) const {
    const auto value = parse_int64(text);
    if (!value || *value < low || *value > high) {
      fail(line_, "'" + printable(key) + "': '" + printable(text) + "' is not a whole number from " +
                      std::to_string(low) + " to " + std::to_string(high));
    }
    return static_cast<int>(*value);
  }

  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    throw Error(name_ + ":" + std::to_string(line) + ": " + message);
  }

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 0;
  std::set<std::string_view> seen_;
  std::optional<int> count_, bits_, correctable_;
  std::vector<MarkerLine> markers_;
};

}  // namespace

ArucoDictionary predefined_aruco_dictionary(std::string_view name) {
  const auto found = find_predefined_dictionary(name);
  if (!found) {
    throw Error("aruco: no dictionary '" + printable(name) + "'; there are " + predefined_dictionary_names());
  }
  return vision().predefined_dictionary(found->opencv_id);
}

ArucoDictionary parse_aruco_dictionary(std::string_view text, const std::string& name) {
  return Parser(text, name).parse();
}

std::string aruco_file(std::string_view family) {
  constexpr std::string_view kPrefix = "aruco:";
  const bool is_file = family.ends_with(".yml") || family.ends_with(".yaml");
  return family.starts_with(kPrefix) && is_file ? std::string(family.substr(kPrefix.size())) : std::string();
}

ArucoDictionary read_aruco_dictionary(const std::filesystem::path& path) {
  return parse_aruco_dictionary(read_file(path, kLargestFile_bytes), path.string());
}

}  // namespace asperity

#include "ply_header.h"

#include <charconv>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "statement_lines.h"

namespace asperity {

namespace {

constexpr std::size_t kMaxLine = 4096;
constexpr std::size_t kMaxElements = 64;
constexpr std::size_t kMaxProperties = 256;

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PlyHeader parse() {
    if (next_line() != "ply") fail("is not a PLY: it does not begin with 'ply'");
    format();
    for (;;) {
      std::string_view rest = next_line();
      const std::string_view keyword = next_word(rest);
      if (keyword == "end_header") break;
      if (keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "element") {
        element(rest);
      } else if (keyword == "property") {
        property(rest);
      } else {
        fail("'" + printable(keyword) + "' in the header");
      }
    }
    header_.bytes = position_;
    for (const PlyElement& e : header_.elements) require_bytes(e);
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(name_ + ":" + std::to_string(header_.lines) + ": " + message);
  }

  std::string_view next_line() {
    ++header_.lines;
    const std::string_view rest = bytes_.substr(position_, kMaxLine + 1);
    const std::size_t newline = rest.find('\n');
    if (newline == std::string_view::npos) {
      fail(rest.size() > kMaxLine ? "a header line of more than 4096 bytes" : "the header has no 'end_header'");
    }
    position_ += newline + 1;
    return trim(rest.substr(0, newline));
  }

  void format() {
    std::string_view rest = next_line();
    const std::string_view keyword = next_word(rest);
    const std::string_view kind = next_word(rest);
    if (keyword != "format" || next_word(rest) != "1.0")
      fail("'format ascii|binary_little_endian|binary_big_endian 1.0' is needed");
    if (kind == "binary_little_endian") {
      header_.order = std::endian::little;
    } else if (kind == "binary_big_endian") {
      header_.order = std::endian::big;
    } else if (kind != "ascii") {
      fail("format '" + printable(kind) + "' is not known");
    }
  }

  void element(std::string_view rest) {
    if (header_.elements.size() == kMaxElements) fail("more than " + std::to_string(kMaxElements) + " elements");
    PlyElement& e = header_.elements.emplace_back();
    e.name = next_word(rest);
    const std::string_view count = next_word(rest);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), e.count);
    if (e.name.empty() || error != std::errc{} || end != count.data() + count.size()) {
      fail("element '" + printable(e.name) + "' with the count '" + printable(count) + "'");
    }
  }

  PlyType type(std::string_view word) const {
    if (word == "char" || word == "int8") return PlyType::kInt8;
    if (word == "uchar" || word == "uint8") return PlyType::kUint8;
    if (word == "short" || word == "int16") return PlyType::kInt16;
    if (word == "ushort" || word == "uint16") return PlyType::kUint16;
    if (word == "int" || word == "int32") return PlyType::kInt32;
    if (word == "uint" || word == "uint32") return PlyType::kUint32;
    if (word == "float" || word == "float32") return PlyType::kFloat32;
    if (word == "double" || word == "float64") return PlyType::kFloat64;
    fail("type '" + printable(word) + "' is not known");
  }

  void property(std::string_view rest) {
    if (header_.elements.empty()) fail("a property before the first element");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    if (properties.size() == kMaxProperties) fail("more than " + std::to_string(kMaxProperties) + " properties");
    PlyProperty p;
    std::string_view word = next_word(rest);
    if (word == "list") {
      p.count_type = type(next_word(rest));
      if (*p.count_type == PlyType::kFloat32 || *p.count_type == PlyType::kFloat64) fail("a list counted by a float");
      word = next_word(rest);
    }
    p.type = type(word);
    p.name = next_word(rest);
    if (p.name.empty()) fail("a property without a name");
    for (const PlyProperty& other : properties) {
      if (other.name == p.name) fail("property '" + printable(p.name) + "' twice");
    }
    properties.push_back(std::move(p));
  }

  // What is counted must at least fit into the bytes that follow: a digit and a blank for an ascii number.
  void require_bytes(const PlyElement& e) const {
    std::size_t least = 0;
    for (const PlyProperty& p : e.properties) least += header_.order ? size_of(p.count_type.value_or(p.type)) : 2;
    const std::size_t there = bytes_.size() - position_ + 1;
    if (e.count > there / std::max<std::size_t>(least, 1)) {
      throw Error(name_ + ": is cut: " + std::to_string(e.count) + " of element '" + printable(e.name) +
                  "' need more than the " + std::to_string(there - 1) + " bytes after the header");
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t position_ = 0;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 8;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).parse();
}

}  // namespace asperity

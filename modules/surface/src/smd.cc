#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "asperity/base/text.h"
#include "surface_formats.h"

namespace asperity {

namespace {

constexpr char kSectionEnd = '\x03';  // ETX, ends a section

// Words between blanks and NULs, which end the header's texts.
std::vector<std::string_view> smd_words(std::string_view line) {
  constexpr std::string_view kBetween("\0 \t\r", 4);
  std::vector<std::string_view> out;
  for (std::size_t at = line.find_first_not_of(kBetween); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.size(), line.find_first_of(kBetween, at));
    out.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBetween, end);
  }
  return out;
}

// The next line of `text`, which loses it.
std::string_view take_smd_line(std::string_view& text) {
  const std::size_t end = std::min(text.size(), text.find('\n'));
  const std::string_view out = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + 1));
  return out;
}

// One of the header's lines CX and CZ: type, number of points, unit, scale, type of data, and what follows.
struct SmdAxis {
  std::string_view type;
  std::size_t count = 0;
  double unit_m = 0.0;
  double scale = 0.0;
  double increment = 0.0;  // of an incremental axis
};

SmdAxis parse_smd_axis(const std::vector<std::string_view>& words, const std::string& name) {
  const std::string what(words.front());
  if (words.size() < 6) throw Error(fmt::format("{}: {} has {} of its words", name, what, words.size() - 1));
  SmdAxis out;
  out.type = words[1];
  const auto count = parse_int64(words[2]);
  if (!count || *count < 1) throw Error(fmt::format("{}: {} has '{}' points", name, what, printable(words[2])));
  out.count = checked_count(static_cast<std::size_t>(*count), 1, name);
  out.unit_m = length_unit_m(words[3], what, name);
  const auto scale = parse_double(words[4]);
  if (!scale || !std::isfinite(*scale) || *scale == 0.0)
    throw Error(fmt::format("{}: the scale of {} is '{}'", name, what, printable(words[4])));
  out.scale = *scale;
  if (out.type != "I") return out;
  const auto increment = words.size() < 7 ? std::nullopt : parse_double(words[6]);
  if (!increment) throw Error(fmt::format("{}: {} is incremental and has no increment", name, what));
  out.increment = *increment;
  return out;
}

// The sum of all bytes before it follows the third section. Whether the sum is modulo 65,535 or 65,536, and whether the
// end of the section and of its line are in it, writers may see differently: any of these will do.
void check_smd_sum(std::string_view bytes, std::size_t section_end, const std::string& name, Problems& problems) {
  const std::string_view after = bytes.substr(section_end + 1);
  const std::vector<std::string_view> words = smd_words(after.substr(0, after.find_first_of("\x03\x1a")));
  std::string_view word = words.empty() ? std::string_view() : words.front();
  while (word.starts_with('\n')) word.remove_prefix(1);
  const auto stated = parse_int64(word.substr(0, word.find('\n')));
  if (!stated) return;
  std::uint64_t sum = 0;
  for (const char c : bytes.substr(0, section_end)) sum += static_cast<unsigned char>(c);
  constexpr std::uint64_t kModulus = 65535;
  const std::uint64_t with_end = sum + static_cast<unsigned char>(kSectionEnd), with_return = with_end + '\r' + '\n';
  for (const std::uint64_t one : {with_return, with_end + '\n', with_end, sum}) {
    const auto is_stated = [&](std::uint64_t modulus) { return one % modulus == static_cast<std::uint64_t>(*stated); };
    if (is_stated(kModulus) || is_stated(kModulus + 1)) return;
  }
  const std::uint64_t has = after.starts_with("\r\n") ? with_return
                            : after.starts_with('\n') ? with_end + '\n'
                                                      : with_end;
  problems.push_back(
      {"checksum",
       fmt::format("{}: the sum of its bytes is {} (modulo {}), but it states {}: it was changed after it "
                   "was written, or is damaged",
                   name, has % kModulus, kModulus, *stated),
       1});
}

}  // namespace

bool is_smd(std::string_view bytes) {
  return (bytes.starts_with("ISO 5436") || bytes.starts_with("ISO5436")) &&
         bytes.find(kSectionEnd) != std::string_view::npos;
}

SurfaceFile parse_smd(std::string_view bytes, const std::string& name) {
  std::vector<std::string_view> sections;
  std::size_t data_end = 0;
  for (std::size_t begin = 0; sections.size() < 3;) {
    const std::size_t end = bytes.find(kSectionEnd, begin);
    if (end == std::string_view::npos)
      throw Error(fmt::format("{}: ends in section {} of 3", name, sections.size() + 1));
    sections.push_back(bytes.substr(begin, end - begin));
    begin = end + 1;
    data_end = end;
  }
  std::string_view header = sections[0];
  take_smd_line(header);  // the revision, and the file's own name
  const std::vector<std::string_view> feature = smd_words(take_smd_line(header));
  if (feature.empty() || feature.front() != "PRF") {
    throw Error(fmt::format("{}: holds a '{}'; profiles (PRF) are read", name,
                            printable(feature.empty() ? std::string_view() : feature.front())));
  }
  std::optional<SmdAxis> x;
  std::optional<SmdAxis> z;
  while (!header.empty()) {
    const std::vector<std::string_view> words = smd_words(take_smd_line(header));
    if (words.empty()) continue;
    if (words.front() == "CX") x = parse_smd_axis(words, name);
    if (words.front() == "CZ") z = parse_smd_axis(words, name);
    if (words.front() == "CY") throw Error(name + ": has an axis CY; profiles along x are read");
  }
  if (!x || !z) throw Error(name + ": has no line " + (x ? "CZ" : "CX"));
  if (x->type != "I")
    throw Error(fmt::format("{}: CX is of type '{}'; equal steps (I) are read", name, printable(x->type)));
  if (z->type != "A")
    throw Error(fmt::format("{}: CZ is of type '{}'; absolute heights (A) are read", name, printable(z->type)));
  if (x->count != z->count) throw Error(fmt::format("{}: CX has {} points and CZ {}", name, x->count, z->count));
  SurfaceFile out;
  out.format = "SMD";
  out.map.columns = z->count;
  out.map.rows = 1;
  out.map.x_spacing_m = checked_spacing_m(x->increment * x->scale * x->unit_m, "the spacing along x", name);
  // A height takes at least two bytes: what cannot be there takes no memory.
  if (z->count > sections[2].size()) throw Error(fmt::format("{}: {} heights do not fit in it", name, z->count));
  out.map.height_m.reserve(z->count);
  std::string_view data = sections[2];
  while (!data.empty()) {
    const std::vector<std::string_view> words = smd_words(take_smd_line(data));
    if (words.empty()) continue;
    const auto value = words.size() == 1 ? parse_double(words.front()) : std::nullopt;
    if (!value || !std::isfinite(*value)) {
      throw Error(fmt::format("{}: height {} is '{}', not one number", name, out.map.height_m.size() + 1,
                              printable(words.front(), 40)));
    }
    if (out.map.height_m.size() == z->count) throw Error(fmt::format("{}: more than {} heights", name, z->count));
    out.map.height_m.push_back(*value * z->scale * z->unit_m);
  }
  check_smd_sum(bytes, data_end, name, out.problems);
  if (out.map.height_m.size() != z->count)
    throw Error(fmt::format("{}: {} heights where {} are stated", name, out.map.height_m.size(), z->count));
  return out;
}

}  // namespace asperity

#include "obj_words.h"

#include <charconv>
#include <cmath>
#include <string>

#include "asperity/base/text.h"
#include "plausible_coordinate.h"

namespace asperity {

namespace {

// The index that begins `text`, which loses it, resolved among `count` things read so far.
std::uint32_t take_index(const StatementLines& lines, std::string_view& text, std::string_view word, std::size_t count,
                         const char* what) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || (end != text.data() + text.size() && *end != '/')) {
    lines.fail("'" + printable(word) + "' is not a corner of a face");
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (value == 0) lines.fail("'" + printable(word) + "' has index 0; indices begin at 1");
  const auto known = static_cast<std::int64_t>(count);
  if (value > known || value < -known) {
    lines.fail("'" + printable(word) + "' names " + what + " " + std::to_string(value) + ", " + std::to_string(known) +
               " are defined so far");
  }
  return static_cast<std::uint32_t>(value > 0 ? value - 1 : known + value);
}

}  // namespace

double finite_number(const StatementLines& lines, std::string_view word) {
  // std::from_chars is exact but does not take a plus sign.
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) lines.fail("'" + printable(word) + "' is out of range of a double");
  if (error != std::errc{} || end != digits.data() + digits.size()) {
    lines.fail("'" + printable(word) + "' is not a number");
  }
  if (!std::isfinite(value)) lines.fail("'" + printable(word) + "' is not a finite number");
  if (!is_plausible_coordinate(value)) lines.fail("'" + printable(word) + "' is beyond 1e12");
  return value;
}

ObjCorner obj_corner(const StatementLines& lines, std::string_view word, const MeshFile& mesh) {
  ObjCorner corner;
  std::string_view rest = word;
  corner.vertex = take_index(lines, rest, word, mesh.vertices.size(), "vertex");
  if (rest.empty()) return corner;
  rest.remove_prefix(1);
  if (!rest.empty() && rest.front() != '/') {
    corner.texture = take_index(lines, rest, word, mesh.texture_coordinates.size(), "texture coordinate");
  }
  if (rest.empty()) return corner;
  rest.remove_prefix(1);
  if (!rest.empty()) {
    corner.normal = take_index(lines, rest, word, mesh.normals.size(), "normal");
    if (!rest.empty()) lines.fail("'" + printable(word) + "' is not a corner of a face");
  }
  return corner;
}

}  // namespace asperity

#include "asperity/scene/format_x3p.h"

#include <fmt/format.h>

#include <cmath>

#include "asperity/base/error.h"
#include "asperity/base/little_endian.h"
#include "asperity/base/md5.h"
#include "asperity/base/nan.h"
#include "asperity/base/text.h"
#include "stored_zip.h"

namespace asperity {
namespace {

std::string axis(const char* name, const char* type, double increment_m) {
  return fmt::format(
      "      <{0}>\n        <AxisType>{1}</AxisType>\n        <DataType>D</DataType>\n"
      "        <Increment>{2}</Increment>\n        <Offset>0</Offset>\n      </{0}>\n",
      name, type, number_text(increment_m));
}

// Without what would end a comment or the document.
std::string comment_text(const std::string& text) {
  std::string out;
  for (const char c : printable(text, 1000)) out += c == '-' && !out.empty() && out.back() == '-' ? '_' : c;
  return out;
}

}  // namespace

std::string format_x3p(const X3pGrid& grid) {
  constexpr std::size_t kMostHeights = std::size_t{1} << 27;
  const bool profile = grid.rows == 1;
  if (grid.columns == 0 || grid.rows == 0 || grid.rows > kMostHeights / grid.columns ||
      grid.height_m.size() != grid.columns * grid.rows)
    throw Error(fmt::format("x3p: {} heights for a grid of {} x {}", grid.height_m.size(), grid.columns, grid.rows));
  if (!(grid.x_spacing_m > 0.0) || (!profile && !(grid.y_spacing_m > 0.0)))
    throw Error("x3p: the spacing of the heights is not positive");
  std::string data;
  data.reserve(8 * grid.height_m.size());
  for (const double height_m : grid.height_m) {
    if (std::isinf(height_m)) throw Error("x3p: a height is infinite");
    append_little_endian(data, std::isnan(height_m) ? kNan : height_m);
  }
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
      "<p:ISO5436_2 xmlns:p=\"http://www.opengps.eu/2008/ISO5436_2\">\n";
  if (!grid.note.empty()) xml += "  <!-- " + comment_text(grid.note) + " -->\n";
  xml += "  <Record1>\n    <Revision>ISO5436 - 2000</Revision>\n";
  xml += fmt::format("    <FeatureType>{}</FeatureType>\n    <Axes>\n", profile ? "PRF" : "SUR");
  xml += axis("CX", "I", grid.x_spacing_m) + axis("CY", "I", profile ? grid.x_spacing_m : grid.y_spacing_m) +
         axis("CZ", "A", 1.0) + "    </Axes>\n  </Record1>\n";
  xml += fmt::format(
      "  <Record3>\n    <MatrixDimension>\n      <SizeX>{}</SizeX>\n      <SizeY>{}</SizeY>\n      <SizeZ>1</SizeZ>\n"
      "    </MatrixDimension>\n    <DataLink>\n      <PointDataLink>bindata/data.bin</PointDataLink>\n"
      "      <MD5ChecksumPointData>{}</MD5ChecksumPointData>\n    </DataLink>\n  </Record3>\n"
      "  <Record4>\n    <ChecksumFile>md5checksum.hex</ChecksumFile>\n  </Record4>\n</p:ISO5436_2>\n",
      grid.columns, grid.rows, md5_hex(data));
  const std::string checksum = md5_hex(xml) + " *main.xml\n";
  return format_stored_zip({{"main.xml", xml}, {"bindata/data.bin", data}, {"md5checksum.hex", checksum}});
}

}  // namespace asperity

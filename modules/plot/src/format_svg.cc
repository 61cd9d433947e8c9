#include "format_svg.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "asperity/base/base64.h"
#include "asperity/base/html_text.h"
#include "asperity/image/png_image.h"
#include "asperity/plot/format_drawing.h"

namespace asperity {

namespace {

std::string hex(const Colour& c) { return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue); }

std::string opacity(const Colour& c, const char* of) {
  return c.opacity < 1.0 ? fmt::format(" {}-opacity=\"{:g}\"", of, c.opacity) : std::string();
}

// XML has no control characters.
std::string escaped(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return html_text(out);
}

struct SvgWriter {
  std::string out;

  void operator()(const DrawnPath& path) {
    if (path.points.empty()) return;
    out += "<path d=\"";
    const char* pen = "M";
    for (const DrawingPoint& p : path.points) {
      out += fmt::format("{}{:.2f} {:.2f}", pen, p.x_px, p.y_px);
      pen = "L";
    }
    if (path.filled) {
      out += fmt::format("Z\" fill=\"{}\"{}/>\n", hex(path.colour), opacity(path.colour, "fill"));
    } else {
      out += fmt::format("\" fill=\"none\" stroke=\"{}\"{} stroke-width=\"{:g}\" stroke-linejoin=\"round\"{}/>\n",
                         hex(path.colour), opacity(path.colour, "stroke"), path.width_px,
                         path.dashed ? " stroke-dasharray=\"6 4\"" : "");
    }
  }

  void operator()(const DrawnDisc& disc) {
    out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\" fill=\"{}\"{}/>\n", disc.centre.x_px,
                       disc.centre.y_px, disc.radius_px, hex(disc.colour), opacity(disc.colour, "fill"));
  }

  void operator()(const DrawnText& text) {
    constexpr std::array<const char*, 3> kAnchors{"start", "middle", "end"};
    out += fmt::format(
        "<text transform=\"translate({:.2f} {:.2f}){}\" font-size=\"{:g}\" text-anchor=\"{}\"{} "
        "fill=\"{}\">{}</text>\n",
        text.at.x_px, text.at.y_px, text.upwards ? " rotate(-90)" : "", text.size_px,
        kAnchors.at(static_cast<std::size_t>(text.anchor)), text.bold ? " font-weight=\"bold\"" : "", hex(text.colour),
        escaped(text.text));
  }

  void operator()(const DrawnPixels& pixels) {
    const std::string png =
        format_colour_png(static_cast<int>(pixels.columns), static_cast<int>(pixels.rows), pixels.rgb);
    out += fmt::format(
               "<image x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" preserveAspectRatio=\"none\" "
               "style=\"image-rendering:pixelated\" xlink:href=\"data:image/png;base64,",
               pixels.corner.x_px, pixels.corner.y_px, pixels.width_px, pixels.height_px) +
           base64(png) + "\"/>\n";
  }
};

}  // namespace

std::string format_svg(const Drawing& drawing) {
  SvgWriter writer{
      std::string(kSvgBegin) +
      fmt::format("xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
                  "viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" font-family=\"sans-serif\">\n"
                  "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#ffffff\"/>\n",
                  drawing.width_px, drawing.height_px)};
  for (const DrawnShape& shape : drawing.shapes) std::visit(writer, shape);
  return writer.out + "</svg>\n";
}

}  // namespace asperity

// libasperity_plot.so: drawings as PNG and PDF, by Cairo.
#include <cairo-pdf.h>
#include <cairo.h>

#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "../src/plot_library.h"
#include "asperity/base/error.h"
#include "asperity/base/version.h"
#include "asperity/plot/format_drawing.h"

namespace asperity {

namespace {

struct Release {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, Release>;
using Context = std::unique_ptr<cairo_t, Release>;

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw Error(std::string("plot: Cairo: ") + cairo_status_to_string(status));
}

// Exceptions must not pass through Cairo.
cairo_status_t append(void* to, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

struct CairoPainter {
  cairo_t* cairo;

  void ink(const Colour& c) const {
    cairo_set_source_rgba(cairo, c.red / 255.0, c.green / 255.0, c.blue / 255.0, c.opacity);
  }

  void operator()(const DrawnPath& path) const {
    if (path.points.empty()) return;
    cairo_new_path(cairo);
    for (const DrawingPoint& p : path.points) cairo_line_to(cairo, p.x_px, p.y_px);
    ink(path.colour);
    if (path.filled) {
      cairo_close_path(cairo);
      cairo_fill(cairo);
      return;
    }
    const double dashes[] = {6.0, 4.0};
    cairo_set_dash(cairo, dashes, path.dashed ? 2 : 0, 0.0);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, path.width_px);
    cairo_stroke(cairo);
  }

  void operator()(const DrawnDisc& disc) const {
    constexpr double kFullTurn_rad = 6.283185307179586;
    cairo_new_path(cairo);
    cairo_arc(cairo, disc.centre.x_px, disc.centre.y_px, disc.radius_px, 0.0, kFullTurn_rad);
    ink(disc.colour);
    cairo_fill(cairo);
  }

  void operator()(const DrawnText& text) const {
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           text.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, text.size_px);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text.text.c_str(), &extents);
    const double before = text.anchor == TextAnchor::kStart ? 0.0 : text.anchor == TextAnchor::kMiddle ? 0.5 : 1.0;
    cairo_save(cairo);
    cairo_translate(cairo, text.at.x_px, text.at.y_px);
    if (text.upwards) cairo_rotate(cairo, -1.5707963267948966);
    cairo_move_to(cairo, -before * extents.x_advance, 0.0);
    ink(text.colour);
    cairo_show_text(cairo, text.text.c_str());
    cairo_restore(cairo);
  }

  void operator()(const DrawnPixels& pixels) const {
    const Surface image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(pixels.columns),
                                                   static_cast<int>(pixels.rows)));
    check(cairo_surface_status(image.get()));
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image.get()));
    unsigned char* const data = cairo_image_surface_get_data(image.get());
    for (std::size_t row = 0; row < pixels.rows; ++row) {
      for (std::size_t column = 0; column < pixels.columns; ++column) {
        const std::uint8_t* const rgb = &pixels.rgb[3 * (row * pixels.columns + column)];
        const std::uint32_t value = std::uint32_t{rgb[0]} << 16U | std::uint32_t{rgb[1]} << 8U | rgb[2];
        std::memcpy(data + row * stride + 4 * column, &value, sizeof value);
      }
    }
    cairo_surface_mark_dirty(image.get());
    cairo_save(cairo);
    cairo_translate(cairo, pixels.corner.x_px, pixels.corner.y_px);
    cairo_scale(cairo, pixels.width_px / static_cast<double>(pixels.columns),
                pixels.height_px / static_cast<double>(pixels.rows));
    cairo_set_source_surface(cairo, image.get(), 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
    cairo_paint(cairo);
    cairo_restore(cairo);
  }
};

void paint(const Drawing& drawing, cairo_surface_t* surface, double scale) {
  const Context context(cairo_create(surface));
  cairo_t* const cairo = context.get();
  cairo_scale(cairo, scale, scale);
  cairo_set_source_rgb(cairo, 1.0, 1.0, 1.0);
  cairo_paint(cairo);
  for (const DrawnShape& shape : drawing.shapes) std::visit(CairoPainter{cairo}, shape);
  check(cairo_status(cairo));
}

std::string to_png(const Drawing& drawing, double pixels_per_px) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                                   static_cast<int>(drawing.width_px * pixels_per_px),
                                                   static_cast<int>(drawing.height_px * pixels_per_px)));
  check(cairo_surface_status(surface.get()));
  paint(drawing, surface.get(), pixels_per_px);
  std::string out;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &out));
  return out;
}

std::string to_pdf(const Drawing& drawing) {
  constexpr double kPointsPerPx = 72.0 / 96.0;
  std::string out;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &out, kPointsPerPx * drawing.width_px,
                                                            kPointsPerPx * drawing.height_px));
  check(cairo_surface_status(surface.get()));
  // The time of making would differ in every file; Cairo puts the present one unless another is given.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "asperity");
  paint(drawing, surface.get(), kPointsPerPx);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()));
  // The second line is a comment of any four bytes above 127: ours say whose file it is, at the same offsets.
  const std::size_t line = out.find('\n');
  if (line != std::string::npos && out.compare(line, 2, "\n%") == 0 && out.size() > line + kPdfMark.size() &&
      out[line + kPdfMark.size() - 1] == '\n')
    out.replace(line, kPdfMark.size(), kPdfMark);
  return out;
}

}  // namespace

}  // namespace asperity

extern "C" __attribute__((visibility("default"))) const asperity::PlotLibrary* asperity_plot() {
  static const asperity::PlotLibrary table{asperity::kVersion, __VERSION__, asperity::to_png, asperity::to_pdf};
  return &table;
}

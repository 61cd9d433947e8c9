#include "asperity/printing/format_pdf.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "asperity/base/error.h"

namespace asperity {

namespace {

constexpr double kPoint_per_mm = 72.0 / 25.4;
constexpr double kLeastSide_mm = 10.0, kLargestSide_mm = 2000.0;
constexpr double kLargest_mm = 1e4;  // of any coordinate: what is farther is a mistake

// Without an exponent, which PDF does not have.
std::string number(double value, int digits = 6) {
  if (!(std::abs(value) <= kLargest_mm)) throw Error(fmt::format("pdf: {} mm is not a position on a page", value));
  std::string out = fmt::format("{:.{}f}", value, digits);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

// A text of PDF in parentheses.
std::string pdf_string(std::string_view text) {
  std::string out = "(";
  for (const char c : text) {
    if (c == '(' || c == ')' || c == '\\') out += '\\';
    out += c >= ' ' && c <= '~' ? c : '?';
  }
  return out + ")";
}

std::string content_of(const PrintPage& page) {
  std::string out = fmt::format("{} 0 0 {} 0 {} cm\n", number(kPoint_per_mm, 12), number(-kPoint_per_mm, 12),
                                number(page.height_mm * kPoint_per_mm, 12));
  for (const PrintRectangle& box : page.black) {
    out += fmt::format("{} {} {} {} re\n", number(box.left_mm), number(box.top_mm), number(box.width_mm),
                       number(box.height_mm));
  }
  if (!page.black.empty()) out += "f\n";
  out += "0.15 w\n";
  for (const LineStyle style : {LineStyle::kSolid, LineStyle::kDashed}) {
    out += style == LineStyle::kSolid ? "[] 0 d\n" : "[2 1] 0 d\n";
    for (const PrintLine& line : page.lines) {
      if (line.style != style) continue;
      out += fmt::format("{} {} m {} {} l S\n", number(line.x0_mm), number(line.y0_mm), number(line.x1_mm),
                         number(line.y1_mm));
    }
  }
  for (const PrintText& text : page.texts) {
    out += fmt::format("BT /F1 {} Tf 1 0 0 -1 {} {} Tm {} Tj ET\n", number(text.height_mm), number(text.left_mm),
                       number(text.baseline_mm), pdf_string(text.text));
  }
  return out;
}

class Document {
 public:
  // Numbers count from 1.
  void add(const std::string& object) {
    offsets_.push_back(out_.size());
    out_ += fmt::format("{} 0 obj\n{}\nendobj\n", offsets_.size(), object);
  }

  std::string finish(std::size_t info) {
    const std::size_t table = out_.size();
    out_ += fmt::format("xref\n0 {}\n0000000000 65535 f \n", offsets_.size() + 1);
    for (const std::size_t offset : offsets_) out_ += fmt::format("{:010} 00000 n \n", offset);
    out_ += fmt::format("trailer\n<< /Size {} /Root 1 0 R /Info {} 0 R >>\nstartxref\n{}\n%%EOF\n", offsets_.size() + 1,
                        info, table);
    return std::move(out_);
  }

 private:
  std::string out_ = "%PDF-1.7\n%asperity\n";
  std::vector<std::size_t> offsets_;
};

}  // namespace

std::string format_pdf(std::span<const PrintPage> pages, std::string_view title) {
  // 1 the catalogue, 2 the list of pages, 3 the font, then for each page itself and its content, then the title.
  std::string list;
  for (std::size_t i = 0; i < pages.size(); ++i) list += fmt::format("{}{} 0 R", i == 0 ? "" : " ", 4 + 2 * i);
  Document out;
  out.add("<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>");
  out.add(fmt::format("<< /Type /Pages /Count {} /Kids [{}] >>", pages.size(), list));
  out.add("<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>");
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const PrintPage& page = pages[i];
    for (const double side_mm : {page.width_mm, page.height_mm}) {
      if (!(side_mm >= kLeastSide_mm && side_mm <= kLargestSide_mm)) {
        throw Error(fmt::format("pdf: a page with a side of {} mm", side_mm));
      }
    }
    out.add(
        fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Resources << /Font << /F1 3 0 R >> >> "
                    "/Contents {} 0 R >>",
                    number(page.width_mm * kPoint_per_mm, 12), number(page.height_mm * kPoint_per_mm, 12), 5 + 2 * i));
    const std::string content = content_of(page);
    out.add(fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content));
  }
  out.add(fmt::format("<< /Title {} /Producer (asperity) >>", pdf_string(title)));
  return out.finish(4 + 2 * pages.size());
}

}  // namespace asperity

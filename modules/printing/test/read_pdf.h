#pragma once

#include <cmath>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "asperity/printing/print_page.h"
#include "asperity/tracking/detect_tags.h"

namespace asperity {

// What our own PDF says, read back by its text alone: the matrix of each page is applied, so that places are in mm from
// the top left whatever the file's user space is.
inline std::vector<PrintPage> read_pdf(const std::string& pdf) {
  constexpr double kPoint_mm = 25.4 / 72.0;
  std::vector<PrintPage> out;
  double scale = 1.0, x_scale = 1.0, lift = 0.0;
  bool dashed = false;
  std::istringstream lines(pdf);
  const std::regex box(R"(/MediaBox \[0 0 ([0-9.]+) ([0-9.]+)\])"),
      text(R"(BT /F1 ([0-9.]+) Tf 1 0 0 -1 (\S+) (\S+) Tm \((.*)\) Tj ET)");
  std::vector<PrintRectangle> path;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    std::vector<double> numbers;
    std::istringstream words(line);
    std::string word;
    while (words >> word) {
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (*end != '\0') break;
      numbers.push_back(value);
    }
    const auto x = [&](double value) { return value * x_scale * kPoint_mm; };
    const auto y = [&](double value) { return out.back().height_mm - (value * scale + lift) * kPoint_mm; };
    if (std::regex_search(line, match, box)) {
      out.emplace_back();
      out.back().width_mm = std::stod(match[1]) * kPoint_mm;
      out.back().height_mm = std::stod(match[2]) * kPoint_mm;
    } else if (line.ends_with(" cm")) {
      x_scale = numbers.at(0);
      scale = numbers.at(3);
      lift = numbers.at(5);
    } else if (line.ends_with(" re")) {
      path.push_back({x(numbers.at(0)), y(numbers.at(1)), numbers.at(2) * x_scale * kPoint_mm,
                      numbers.at(3) * std::abs(scale) * kPoint_mm});
    } else if (line == "f") {
      out.back().black = std::move(path);
      path.clear();
    } else if (line.ends_with(" 0 d")) {
      dashed = !line.starts_with("[]");
    } else if (line.ends_with(" l S")) {
      std::istringstream parts(line);
      double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
      parts >> x0 >> y0 >> word >> x1 >> y1;
      out.back().lines.push_back({x(x0), y(y0), x(x1), y(y1), dashed ? LineStyle::kDashed : LineStyle::kSolid});
    } else if (std::regex_search(line, match, text)) {
      out.back().texts.push_back({x(std::stod(match[2])), y(std::stod(match[3])), std::stod(match[1]), match[4]});
    }
  }
  return out;
}

// The black areas of a page as a printer of `px_per_mm` would print them: the part of each pixel that is covered. A
// place of x mm is at x·px_per_mm − 0.5 px, for the first pixel's centre is at (0, 0).
inline GrayImage rasterised(const PrintPage& page, double px_per_mm) {
  GrayImage out;
  out.width = static_cast<int>(std::ceil(page.width_mm * px_per_mm));
  out.height = static_cast<int>(std::ceil(page.height_mm * px_per_mm));
  std::vector<double> ink(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height), 0.0);
  for (const PrintRectangle& box : page.black) {
    const double left = box.left_mm * px_per_mm, right = left + box.width_mm * px_per_mm;
    const double top = box.top_mm * px_per_mm, bottom = top + box.height_mm * px_per_mm;
    for (int row = static_cast<int>(top); row < std::min(bottom, double(out.height)); ++row) {
      const double high = std::min(bottom, row + 1.0) - std::max(top, double(row));
      for (int column = static_cast<int>(left); column < std::min(right, double(out.width)); ++column) {
        const double wide = std::min(right, column + 1.0) - std::max(left, double(column));
        ink[static_cast<std::size_t>(row) * static_cast<std::size_t>(out.width) + static_cast<std::size_t>(column)] +=
            wide * high;
      }
    }
  }
  for (const double part : ink)
    out.pixels.push_back(static_cast<std::uint8_t>(std::lround(255.0 - 225.0 * std::min(1.0, part))));
  return out;
}

}  // namespace asperity

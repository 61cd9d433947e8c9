#include "asperity/printing/marker_sheets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "page_parts.h"

namespace asperity {

namespace {

constexpr double kGap_mm = 4.0;
constexpr double kCaption_mm = 5.0;
constexpr double kTab_mm = 8.0;
constexpr std::size_t kMostTags = 1000;
constexpr int kLeastSides = 3, kMostSides = 36;

// The whole picture's width, white margin included, over the black border's.
double whole_part(const TagPattern& pattern) {
  return static_cast<double>(pattern.cells) / static_cast<double>(pattern.border_cells());
}

std::string sheet_note(const TagFamily& family, double size_mm) {
  return fmt::format("asperity: {}, {}", printable(family.name, 40), mm_text(size_mm));
}

// The faces of a ring, laid side by side.
class RingLayout {
 public:
  RingLayout(const TagFamily& family, const RingConfig& config, Paper paper)
      : family_(family), config_(config), paper_(paper), size_mm_(checked_mm("a tag", config.size_m)) {
    if (config.sides < kLeastSides || config.sides > kMostSides) {
      throw Error(
          fmt::format("markers: a ring of {} sides; {} to {} can be folded", config.sides, kLeastSides, kMostSides));
    }
    if (config.first_id < 0 || config.first_id > 1'000'000)
      throw Error("markers: the first id is below 0 or too large");
    double least_mm = 0.0;
    for (int i = 0; i < config.sides; ++i) {
      least_mm = std::max(least_mm, size_mm_ * whole_part(require_pattern(family, config.first_id + i)));
    }
    face_mm_ = config.face_m > 0.0 ? checked_mm("a face", config.face_m) : least_mm;
    if (face_mm_ < least_mm) {
      throw Error(fmt::format("markers: a face of {} does not hold a tag of {} with its white margin, {}",
                              mm_text(face_mm_), mm_text(size_mm_), mm_text(least_mm)));
    }
  }

  MarkerPrint layout() {
    place_markers();
    begin_page();
    const int most = static_cast<int>(std::floor((frame_.width_mm() - kTab_mm) / face_mm_));
    if (most < 1 || face_mm_ + kCaption_mm > frame_.height_mm()) {
      throw Error(
          fmt::format("markers: a face of {} does not fit on the page; at most {} do", mm_text(face_mm_),
                      mm_text(std::floor(std::min(frame_.width_mm() - kTab_mm, frame_.height_mm() - kCaption_mm)))));
    }
    const int strips = (config_.sides + most - 1) / most;
    for (int strip = 0, face = 0; strip < strips; ++strip) {
      const int faces = config_.sides / strips + (strip < config_.sides % strips ? 1 : 0);
      add_strip(face, faces);
      face += faces;
    }
    add_end();
    return std::move(out_);
  }

 private:
  void place_markers() {
    const double face_m = face_mm_ * 1e-3;
    const double apothem_m = face_m / (2.0 * std::tan(std::numbers::pi / config_.sides));
    for (int i = 0; i < config_.sides; ++i) {
      const double theta = 2.0 * std::numbers::pi * i / config_.sides;
      MarkerPlacement marker;
      marker.id = config_.first_id + i;
      marker.family = family_.name;
      marker.size_m = config_.size_m;
      marker.T_marker_tag.translation_m = {apothem_m * std::sin(theta), 0.0, apothem_m * (1.0 - std::cos(theta))};
      marker.T_marker_tag.rotation = {std::cos(0.5 * theta), 0.0, 0.0 - std::sin(0.5 * theta), 0.0};
      out_.markers.push_back(marker);
    }
  }

  void begin_page() {
    out_.pages.push_back(ruled_page(paper_, true, sheet_note(family_, size_mm_)));
    frame_ = frame_of(out_.pages.back());
    top_mm_ = frame_.top_mm;
  }

  void add_strip(int first, int faces) {
    if (top_mm_ + kCaption_mm + face_mm_ > frame_.bottom_mm) begin_page();
    PrintPage& page = out_.pages.back();
    const double top_mm = top_mm_ + kCaption_mm, bottom_mm = top_mm + face_mm_, left_mm = frame_.left_mm;
    for (int i = 0; i < faces; ++i) {
      const double face_left_mm = left_mm + i * face_mm_;
      const int id = config_.first_id + first + i;
      const double inset_mm = 0.5 * (face_mm_ - size_mm_);
      add_pattern(page, require_pattern(family_, id), face_left_mm + inset_mm, top_mm + inset_mm, size_mm_);
      page.texts.push_back({face_left_mm + 1.0, top_mm - 1.5, 2.8, fmt::format("face {}, id {}", first + i, id)});
      page.lines.push_back({face_left_mm + face_mm_, top_mm, face_left_mm + face_mm_, bottom_mm, LineStyle::kDashed});
    }
    const double right_mm = left_mm + faces * face_mm_;
    page.lines.push_back({left_mm, top_mm, right_mm, top_mm});
    page.lines.push_back({left_mm, bottom_mm, right_mm, bottom_mm});
    page.lines.push_back({left_mm, top_mm, left_mm, bottom_mm});
    const double slant_mm = std::min(3.0, 0.2 * face_mm_);
    page.lines.push_back({right_mm, top_mm, right_mm + kTab_mm, top_mm + slant_mm});
    page.lines.push_back({right_mm + kTab_mm, top_mm + slant_mm, right_mm + kTab_mm, bottom_mm - slant_mm});
    page.lines.push_back({right_mm + kTab_mm, bottom_mm - slant_mm, right_mm, bottom_mm});
    page.texts.push_back({right_mm + 1.0, top_mm + 0.5 * face_mm_, 2.8, "glue"});
    top_mm_ = bottom_mm + kGap_mm;
  }

  // Left out where it is larger than a page.
  void add_end() {
    const double radius_mm = face_mm_ / (2.0 * std::sin(std::numbers::pi / config_.sides));
    if (2.0 * radius_mm > std::min(frame_.width_mm(), frame_.height_mm() - kCaption_mm)) return;
    if (top_mm_ + kCaption_mm + 2.0 * radius_mm > frame_.bottom_mm) begin_page();
    PrintPage& page = out_.pages.back();
    const double x_mm = frame_.left_mm + radius_mm, y_mm = top_mm_ + kCaption_mm + radius_mm;
    const auto corner = [&](int i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / config_.sides;
      return std::pair(x_mm + radius_mm * std::sin(angle), y_mm + radius_mm * std::cos(angle));
    };
    for (int i = 0; i < config_.sides; ++i) {
      const auto [x0, y0] = corner(i);
      const auto [x1, y1] = corner(i + 1);
      page.lines.push_back({x0, y0, x1, y1});
    }
    page.texts.push_back({frame_.left_mm, top_mm_ + kCaption_mm - 1.5, 2.8, "end: cut out twice, of cardboard"});
  }

  const TagFamily& family_;
  const RingConfig& config_;
  Paper paper_;
  double size_mm_;
  double face_mm_ = 0.0;
  MarkerPrint out_;
  PageFrame frame_;
  double top_mm_ = 0.0;
};

}  // namespace

MarkerPrint layout_tags(const TagFamily& family, const std::vector<int>& ids, double size_m, Paper paper) {
  const double size_mm = checked_mm("a tag", size_m);
  if (ids.empty() || ids.size() > kMostTags) {
    throw Error(fmt::format("markers: {} tags; a sheet takes 1 to {}", ids.size(), kMostTags));
  }
  const std::string note = sheet_note(family, size_mm);
  MarkerPrint out;
  PageFrame frame;
  double left_mm = 0.0, top_mm = 0.0;
  for (const int id : ids) {
    const TagPattern pattern = require_pattern(family, id);
    const double whole_mm = size_mm * whole_part(pattern);
    const bool first = out.pages.empty();
    if (!first && left_mm + whole_mm > frame.right_mm) {
      left_mm = frame.left_mm;
      top_mm += whole_mm + kCaption_mm + kGap_mm;
    }
    if (first || top_mm + whole_mm + kCaption_mm > frame.bottom_mm) {
      out.pages.push_back(ruled_page(paper, false, note));
      frame = frame_of(out.pages.back());
      left_mm = frame.left_mm;
      top_mm = frame.top_mm;
    }
    const double room_mm = std::min(frame.width_mm(), frame.height_mm() - kCaption_mm);
    if (whole_mm > room_mm) {
      throw Error(fmt::format("markers: a tag of {} does not fit on the page; at most {} do", mm_text(size_mm),
                              mm_text(std::floor(room_mm / whole_part(pattern)))));
    }
    PrintPage& page = out.pages.back();
    const double inset_mm = 0.5 * (whole_mm - size_mm);
    add_pattern(page, pattern, left_mm + inset_mm, top_mm + inset_mm, size_mm);
    add_outline(page, left_mm, top_mm, whole_mm, whole_mm);
    page.texts.push_back({left_mm, top_mm + whole_mm + 3.5, 2.8,
                          fmt::format("{} id {}, {}", printable(family.name, 24), id, mm_text(size_mm))});
    MarkerPlacement marker;
    marker.id = id;
    marker.family = family.name;
    marker.size_m = size_m;
    marker.T_marker_tag.translation_m = {left_mm * 1e-3, top_mm * 1e-3, 0.0};
    out.markers.push_back(marker);
    left_mm += whole_mm + kGap_mm;
  }
  const Eigen::Vector3d origin_m = out.markers.front().T_marker_tag.translation_m;
  for (MarkerPlacement& marker : out.markers) marker.T_marker_tag.translation_m -= origin_m;
  if (out.pages.size() > 1) out.markers.clear();
  return out;
}

MarkerPrint layout_ring(const TagFamily& family, const RingConfig& config, Paper paper) {
  return RingLayout(family, config, paper).layout();
}

}  // namespace asperity

#include "aruco_tag_detector.h"

#include <string_view>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/tracking/aruco_dictionary.h"
#include "asperity/tracking/detect_aruco.h"

namespace asperity {

namespace {

class ArucoTagDetector final : public TagDetector {
 public:
  explicit ArucoTagDetector(ArucoDictionary dictionary) : dictionary_(std::move(dictionary)), detector_(dictionary_) {}

  void detect(const GrayImage& image, const ImageRegion& region, std::vector<TagDetection>& out) override {
    if (region.left < 0 || region.top < 0 || region.right > image.width || region.bottom > image.height) {
      throw Error("detect_tags: the region is not inside the image");
    }
    if (region.empty()) return;
    part_.width = region.width();
    part_.height = region.height();
    part_.pixels.resize(static_cast<std::size_t>(part_.width) * static_cast<std::size_t>(part_.height));
    for (int row = 0; row < part_.height; ++row) {
      const auto from =
          image.pixels.begin() + static_cast<std::ptrdiff_t>(region.top + row) * image.width + region.left;
      std::copy(from, from + part_.width, part_.pixels.begin() + static_cast<std::ptrdiff_t>(row) * part_.width);
    }
    for (TagDetection& tag : detector_.detect(part_)) {
      tag.corners_px.colwise() += Eigen::Vector2d(region.left, region.top);
      out.push_back(tag);
    }
  }

  std::optional<TagPattern> pattern(int id) const override {
    if (id < 0 || static_cast<std::size_t>(id) >= dictionary_.markers.size()) return std::nullopt;
    const auto& marker = dictionary_.markers[static_cast<std::size_t>(id)];
    TagPattern out;
    out.cells = dictionary_.bits + 4;
    out.margin = 1;
    for (int row = -2; row < dictionary_.bits + 2; ++row) {
      for (int column = -2; column < dictionary_.bits + 2; ++column) {
        const int beyond = std::max({-row, -column, row - dictionary_.bits + 1, column - dictionary_.bits + 1});
        const bool white =
            beyond == 2 || (beyond <= 0 && marker[static_cast<std::size_t>(row * dictionary_.bits + column)]);
        out.white.push_back(white ? 1 : 0);
      }
    }
    return out;
  }

 private:
  ArucoDictionary dictionary_;
  ArucoDetector detector_;
  GrayImage part_;
};

}  // namespace

bool is_aruco_family(std::string_view family) { return family.starts_with("aruco:"); }

std::unique_ptr<TagDetector> make_aruco_tag_detector(const std::string& family) {
  const std::string file = aruco_file(family);
  return std::make_unique<ArucoTagDetector>(
      file.empty() ? predefined_aruco_dictionary(std::string_view(family).substr(family.find(':') + 1))
                   : read_aruco_dictionary(file));
}

}  // namespace asperity

#include "apriltag_detector.h"

#include <array>
#include <utility>

#include <apriltag.h>
#include <tag16h5.h>
#include <tag25h9.h>
#include <tag36h11.h>
#include <tagStandard41h12.h>

#include "asperity/base/error.h"

namespace asperity {
namespace {

struct Family {
  std::string_view name;
  apriltag_family_t* (*create)();
  void (*destroy)(apriltag_family_t*);
};

constexpr std::array<Family, 4> kFamilies{{{"tag36h11", tag36h11_create, tag36h11_destroy},
                                           {"tag25h9", tag25h9_create, tag25h9_destroy},
                                           {"tag16h5", tag16h5_create, tag16h5_destroy},
                                           {"tagStandard41h12", tagStandard41h12_create, tagStandard41h12_destroy}}};

const Family* find_family(std::string_view name) {
  const auto* const found =
      std::find_if(kFamilies.begin(), kFamilies.end(), [&](const Family& family) { return family.name == name; });
  return found == kFamilies.end() ? nullptr : found;
}

class ApriltagDetector : public TagDetector {
 public:
  ApriltagDetector(const Family& family, const TagDetectorConfig& config)
      : family_(family.create(), family.destroy), detector_(apriltag_detector_create(), apriltag_detector_destroy) {
    if (!family_ || !detector_) throw Error("apriltag: no detector could be made");
    apriltag_detector_add_family_bits(detector_.get(), family_.get(), config.bits_corrected);
    detector_->nthreads = 1;
    detector_->quad_decimate = static_cast<float>(config.quad_decimate);
    detector_->refine_edges = true;
  }

  void detect(const GrayImage& image, const ImageRegion& region, std::vector<TagDetection>& out) override {
    // Below this the library's filters have no room.
    constexpr int kLeast_px = 16;
    if (region.left < 0 || region.top < 0 || region.right > image.width || region.bottom > image.height) {
      throw Error("detect_tags: the region is not inside the image");
    }
    if (region.width() < kLeast_px || region.height() < kLeast_px) return;
    const std::size_t first = static_cast<std::size_t>(region.top) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(region.left);
    // The library's structure has no const, but without its own blur the detector reads only.
    image_u8_t view{region.width(), region.height(), image.width,
                    const_cast<std::uint8_t*>(image.pixels.data() + first)};
    const std::unique_ptr<zarray_t, void (*)(zarray_t*)> found(apriltag_detector_detect(detector_.get(), &view),
                                                               apriltag_detections_destroy);
    for (int i = 0; i < zarray_size(found.get()); ++i) {
      apriltag_detection_t* tag = nullptr;
      zarray_get(found.get(), i, &tag);
      TagDetection detection;
      detection.id = tag->id;
      // The library counts from the tag's bottom left against the clock, and from a pixel's corner.
      for (int corner = 0; corner < 4; ++corner) {
        detection.corners_px.col(corner) =
            Eigen::Vector2d(tag->p[3 - corner][0] + region.left - 0.5, tag->p[3 - corner][1] + region.top - 0.5);
      }
      out.push_back(detection);
    }
  }

  std::optional<TagPattern> pattern(int id) const override {
    if (id < 0 || static_cast<std::uint32_t>(id) >= family_->ncodes) return std::nullopt;
    const apriltag_family_t& family = *family_;
    TagPattern out;
    out.cells = family.total_width;
    out.margin = (family.total_width - family.width_at_border) / 2;
    out.white.assign(static_cast<std::size_t>(out.cells * out.cells), 0);
    const auto set_white = [&](int column, int row) {
      out.white[static_cast<std::size_t>(row * out.cells + column)] = 1;
    };
    // A white ring round the black border, or inside of it where black and white change places.
    const int first = family.reversed_border ? out.margin : out.margin - 1, last = out.cells - 1 - first;
    for (int i = first; i <= last; ++i) {
      for (const int edge : {first, last}) {
        set_white(i, edge);
        set_white(edge, i);
      }
    }
    for (std::uint32_t bit = 0; bit < family.nbits; ++bit) {
      if ((family.codes[id] >> (family.nbits - 1 - bit) & 1U) == 0) continue;
      set_white(out.margin + static_cast<int>(family.bit_x[bit]), out.margin + static_cast<int>(family.bit_y[bit]));
    }
    return out;
  }

 private:
  std::unique_ptr<apriltag_family_t, void (*)(apriltag_family_t*)> family_;
  std::unique_ptr<apriltag_detector_t, void (*)(apriltag_detector_t*)> detector_;
};

}  // namespace

std::vector<std::string_view> apriltag_families() {
  std::vector<std::string_view> out;
  for (const Family& family : kFamilies) out.push_back(family.name);
  return out;
}

bool is_apriltag_family(std::string_view family) { return find_family(family) != nullptr; }

std::unique_ptr<TagDetector> make_apriltag_detector(const std::string& family, const TagDetectorConfig& config) {
  return std::make_unique<ApriltagDetector>(*find_family(family), config);
}

}  // namespace asperity

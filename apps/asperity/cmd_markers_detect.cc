#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/image/read_gray_image.h"
#include "asperity/json/json.h"
#include "asperity/session/our_file.h"
#include "asperity/tracking/detect_tags.h"
#include "commands.h"

namespace asperity::app {

namespace {

constexpr std::string_view kHeader = "image,id,x0_px,y0_px,x1_px,y1_px,x2_px,y2_px,x3_px,y3_px\n";

class MarkersDetectCommand : public Command {
 public:
  explicit MarkersDetectCommand(Parser& markers) : Command(markers, "detect", "Find tags and their corners in images") {
    require(parser().add_option("IMAGE", images_, "PNG, JPEG or PGM"));
    parser()
        .add_option("--family", family_, "tag36h11, tag25h9, tag16h5, tagStandard41h12, aruco:NAME or aruco:FILE.yml")
        ->suggest(apriltag_families())
        ->suggest(std::array{"aruco:"})
        ->show_default();
    parser().add_option("-o,--output", output_, "Write a table of the corners")->type_name("FILE.csv");
  }

  std::vector<ConfigField> fields() override { return list_fields("detector", config_); }

  int run(const Observer& observer) override {
    if (!output_.empty()) refuse_stranger(output_, kHeader, images_);
    const std::unique_ptr<TagDetector> detector = make_tag_detector(family_, config_);
    std::string table(kHeader), text;
    Json images = Json::array();
    std::size_t found = 0;
    std::vector<TagDetection> tags;
    for (std::size_t i = 0; i < images_.size(); ++i) {
      observer.update("detecting", static_cast<double>(i) / static_cast<double>(images_.size()));
      const GrayImage image = read_gray_image(images_[i]);
      tags.clear();
      detector->detect(image, whole(image), tags);
      std::stable_sort(tags.begin(), tags.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
      found += tags.size();
      const std::string name = printable(images_[i], 300);
      if (!output_.empty() && name.find(',') != std::string::npos) {
        throw Error(name + ": the name has a comma, which the table cannot hold; rename the file");
      }
      text += fmt::format("{}: {} marker{}\n", name, tags.size(), tags.size() == 1 ? "" : "s");
      Json markers = Json::array();
      for (const TagDetection& tag : tags) {
        table += fmt::format("{},{}", name, tag.id);
        text += fmt::format("  id {:<4}", tag.id);
        Json corners = Json::array();
        for (int k = 0; k < 4; ++k) {
          const double x = tag.corners_px(0, k), y = tag.corners_px(1, k);
          table += fmt::format(",{:.3f},{:.3f}", x, y);
          text += fmt::format("  ({:.2f}, {:.2f})", x, y);
          corners.push_back({x, y});
        }
        table += '\n';
        text += '\n';
        markers.push_back({{"id", tag.id}, {"corners_px", corners}});
      }
      images.push_back({{"image", images_[i]}, {"markers", markers}});
    }
    if (!output_.empty()) write_file(output_, table);
    const Json out{{"format", "asperity-markers-detect"}, {"version", 1}, {"family", family_}, {"images", images}};
    print_json(out.dump_repaired(2));
    say(text);
    if (found == 0) print_error("no marker of " + printable(family_) + " was found");
    return found == 0 ? kNotTrustworthy : kDone;
  }

 private:
  std::vector<std::string> images_;
  std::string family_ = "tag36h11", output_;
  TagDetectorConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_markers_detect(Parser& markers) {
  return std::make_unique<MarkersDetectCommand>(markers);
}

}  // namespace asperity::app

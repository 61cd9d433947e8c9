#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/printing/format_pdf.h"
#include "asperity/printing/marker_sheets.h"
#include "asperity/recording/format_recording.h"
#include "asperity/session/our_file.h"
#include "asperity/tracking/aruco_dictionary.h"
#include "asperity/tracking/detect_tags.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// The pictures of a family by its name (asperity/tracking/detect_tags.h). Throws Error for one that is not known.
TagFamily open_family(const std::string& name) {
  const std::shared_ptr<TagDetector> detector = make_tag_detector(name);
  return {name, [detector](int id) { return detector->pattern(id); }};
}

// The name of `family` in a markers.json in `folder`: a dictionary's file is named from there. Throws Error if it does
// not lie in that folder or one within, for a body's file reaches no other.
std::string family_beside(const std::string& family, const fs::path& folder) {
  const std::string file = aruco_file(family);
  if (file.empty()) return family;
  const fs::path inner =
      fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder.empty() ? "." : folder));
  if (inner.empty() || *inner.begin() == "..") {
    throw Error("--markers: the dictionary " + printable(file, 200) +
                " is not in the folder of the body's file: put it there");
  }
  return "aruco:" + inner.generic_string();
}

constexpr std::string_view kPdfHeader = "%PDF-1.7\n%asperity\n";

bool begins_as_markers(std::string_view begin) { return begin.find("\"asperity-markers\"") != std::string_view::npos; }

// "0,1,4-7".
std::vector<int> ids_option(const std::string& text) {
  std::vector<int> out;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string part = text.substr(at, end - at);
    const auto dash = part.find('-', 1);
    const auto first = parse_int64(part.substr(0, dash));
    const auto last = dash == std::string::npos ? first : parse_int64(part.substr(dash + 1));
    if (!first || !last || *first < 0 || *last < *first || *last > 1'000'000 || *last - *first >= 1000) {
      throw UsageError("--ids: '" + printable(part) + "' is not an id or a span of at most 1000, such as 0-5");
    }
    for (auto id = *first; id <= *last; ++id) {
      if (std::find(out.begin(), out.end(), id) != out.end())
        throw UsageError("--ids: " + std::to_string(id) + " is given twice; a body has each tag once");
      out.push_back(static_cast<int>(id));
    }
    if (out.size() > 1000) throw UsageError("--ids: more than 1000");
    at = end + 1;
  }
  return out;
}

// "9x6".
std::pair<int, int> board_option(const std::string& text) {
  const auto x = text.find('x');
  const auto columns = parse_int64(text.substr(0, x));
  const auto rows = x == std::string::npos ? std::nullopt : parse_int64(text.substr(x + 1));
  if (!columns || !rows || *columns < 1 || *rows < 1 || *columns > 1000 || *rows > 1000) {
    throw UsageError("--board: '" + printable(text) + "' is not COLUMNSxROWS, such as 9x6");
  }
  return {static_cast<int>(*columns), static_cast<int>(*rows)};
}

// What all commands that print share: paper, the PDF, and the markers.json of what they print.
class PrintCommand : public Command {
 public:
  PrintCommand(Parser& markers, const std::string& name, const std::string& description)
      : Command(markers, name, description) {
    require(parser().add_option("-o,--output", output_, "File of the pages")->type_name("FILE.pdf"));
    parser().add_option("--paper", paper_, "a4 or letter")->one_of({"a4", "letter"})->show_default();
  }

  int run(const Observer&) override {
    refuse_stranger(output_, kPdfHeader);
    if (!markers_.empty()) refuse_stranger(markers_, begins_as_markers, {output_});
    MarkerPrint print = layout(paper_ == "letter" ? Paper::kLetter : Paper::kA4);
    if (!markers_.empty() && print.markers.empty()) {
      throw Error("--markers: tags on several pages are not one rigid body; choose fewer tags or a larger page");
    }
    if (!markers_.empty()) {
      for (MarkerPlacement& marker : print.markers) {
        marker.family = family_beside(marker.family, std::filesystem::path(markers_).parent_path());
      }
      write_file(markers_, format_markers(print.markers));
    }
    write_file(output_, format_pdf(print.pages, "asperity markers"));
    Json out{{"format", "asperity-markers-print"}, {"version", 1}, {"output", output_}, {"pages", print.pages.size()}};
    if (!markers_.empty()) out["markers"] = markers_;
    print_json(out.dump_repaired(2));
    say(fmt::format("{}: {} page{}{}\nPrint at 100 %, without fitting to the page, and measure both rulers.\n",
                    printable(output_, 200), print.pages.size(), print.pages.size() == 1 ? "" : "s",
                    markers_.empty() ? "" : "; the body is in " + printable(markers_, 200)));
    return kDone;
  }

 protected:
  virtual MarkerPrint layout(Paper paper) = 0;

  void add_family(const std::string& default_family) {
    family_ = default_family;
    parser()
        .add_option("--family", family_, "tag36h11, tag25h9, tag16h5, tagStandard41h12, aruco:NAME or aruco:FILE.yml")
        ->suggest(apriltag_families())
        ->suggest(std::array{"aruco:"})
        ->show_default();
  }
  void add_markers() {
    parser()
        .add_option("--markers", markers_, "Write the body too: the positions of its tags")
        ->type_name("markers.json");
  }
  TagFamily family() const { return open_family(family_); }

 private:
  std::string output_, markers_, family_;
  std::string paper_ = "a4";
};

class SheetCommand : public PrintCommand {
 public:
  explicit SheetCommand(Parser& markers) : PrintCommand(markers, "sheet", "Flat tags to print and cut out") {
    add_family("tag36h11");
    add_markers();
    parser().add_option("--size", size_, "The black border's outer edge")->show_default();
    parser().add_option("--ids", ids_, "Ids, such as 0,1,4-7")->show_default();
  }

 private:
  MarkerPrint layout(Paper paper) override {
    return layout_tags(family(), ids_option(ids_), length_option_m("--size", size_), paper);
  }
  std::string size_ = "46mm", ids_ = "0";
};

class RingCommand : public PrintCommand {
 public:
  explicit RingCommand(Parser& markers)
      : PrintCommand(markers, "ring", "A prism of tags to print and fold, seen from all around") {
    add_family("tag36h11");
    add_markers();
    parser().add_option("--size", size_, "The black border's outer edge")->show_default();
    parser().add_option("--sides", config_.sides, "Faces, 3 to 36")->show_default();
    parser().add_option("--first-id", config_.first_id, "The id of face 0")->show_default();
    parser().add_option("--face", face_, "Width of a face; default: a tag with its white margin");
  }

 private:
  MarkerPrint layout(Paper paper) override {
    config_.size_m = length_option_m("--size", size_);
    if (!face_.empty()) config_.face_m = length_option_m("--face", face_);
    return layout_ring(family(), config_, paper);
  }
  std::string size_ = "46mm", face_;
  RingConfig config_;
};

class BoardCommand : public PrintCommand {
 public:
  explicit BoardCommand(Parser& markers)
      : PrintCommand(markers, "board", "A checkerboard to calibrate the camera with") {
    parser().add_option("--board", board_, "Inner corners, COLUMNSxROWS")->show_default();
    parser().add_option("--square", square_, "Width of a square")->show_default();
  }

 private:
  MarkerPrint layout(Paper paper) override {
    const auto [columns, rows] = board_option(board_);
    return {{layout_checkerboard(columns, rows, length_option_m("--square", square_), paper)}, {}};
  }
  std::string board_ = "9x6", square_ = "25mm";
};

class CharucoCommand : public PrintCommand {
 public:
  explicit CharucoCommand(Parser& markers)
      : PrintCommand(markers, "charuco", "A ChArUco board to calibrate the camera with, as OpenCV 4.6 numbers it") {
    add_family("aruco:DICT_4X4_50");
    parser().add_option("--board", board_, "Squares, COLUMNSxROWS")->show_default();
    parser().add_option("--square", square_, "Width of a square")->show_default();
    parser().add_option("--marker", marker_, "Width of a marker")->show_default();
  }

 private:
  MarkerPrint layout(Paper paper) override {
    const auto [columns, rows] = board_option(board_);
    return {{layout_charuco(family(), columns, rows, length_option_m("--square", square_),
                            length_option_m("--marker", marker_), paper)},
            {}};
  }
  std::string board_ = "7x5", square_ = "30mm", marker_ = "22mm";
};

}  // namespace

std::unique_ptr<Command> make_markers_sheet(Parser& markers) { return std::make_unique<SheetCommand>(markers); }
std::unique_ptr<Command> make_markers_ring(Parser& markers) { return std::make_unique<RingCommand>(markers); }
std::unique_ptr<Command> make_markers_board(Parser& markers) { return std::make_unique<BoardCommand>(markers); }
std::unique_ptr<Command> make_markers_charuco(Parser& markers) { return std::make_unique<CharucoCommand>(markers); }

}  // namespace asperity::app

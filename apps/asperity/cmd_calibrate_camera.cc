#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "asperity/base/text.h"
#include "asperity/calibration/calibrate_camera.h"
#include "asperity/calibration/find_board.h"
#include "asperity/image/read_gray_image.h"
#include "calibrate_command.h"
#include "commands.h"
#include "image_files.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
constexpr std::size_t kMostImages = 1000;

struct CameraSettings {
  CameraFitConfig fit;
  FindBoardConfig find;

  template <class V>
  void visit(V& v) {
    fit.visit(v);
    v.group("find", find);
  }
};

std::pair<int, int> board_option(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto columns = parse_int64(text.substr(0, cross));
  const auto rows = cross == std::string::npos ? std::nullopt : parse_int64(text.substr(cross + 1));
  if (!columns || !rows || *columns < 1 || *rows < 1 || *columns > 1000 || *rows > 1000) {
    throw UsageError("--board: '" + printable(text) + "' is not two numbers such as 9x6");
  }
  return {static_cast<int>(*columns), static_cast<int>(*rows)};
}

// A board counted the other way, squares for corners or corners for squares.
CalibrationBoard counted_otherwise(CalibrationBoard board) {
  const int more = board.kind == BoardKind::kCharuco ? 1 : -1;
  board.columns += more;
  board.rows += more;
  return board;
}

class CalibrateCameraCommand : public CalibrateCommand {
 public:
  explicit CalibrateCameraCommand(Parser& calibrate)
      : CalibrateCommand(calibrate, "camera",
                         "The camera's focal length, centre and distortion from images of a board") {
    require(parser().add_option("IMAGES", paths_, "Images of the board, or folders of them"));
    require(parser()
                .add_option("--board", size_,
                            "Inner corners of a checkerboard (9x6: 10 by 7 squares); of a ChArUco board its squares")
                ->type_name("COLUMNSxROWS"));
    require(parser().add_option("--square", square_, "A square's edge")->type_name("LENGTH"));
    parser().add_flag("--charuco", charuco_, "A ChArUco board");
    parser().add_option("--marker", marker_, "ChArUco: a marker's edge")->type_name("LENGTH");
    parser().add_option("--dictionary", dictionary_, "ChArUco: DICT_4X4_50 or another of OpenCV's")->show_default();
  }

  std::vector<ConfigField> fields() override { return list_fields("calibration", settings_); }

  void apply_options() override {
    if (!size_.empty()) std::tie(board_.columns, board_.rows) = board_option(size_);
    if (!square_.empty()) board_.square_m = length_option_m("--square", square_);
    if (charuco_ == marker_.empty()) throw UsageError("--charuco and --marker need each other");
    if (!charuco_) return;
    board_.kind = BoardKind::kCharuco;
    board_.marker_m = length_option_m("--marker", marker_);
    board_.dictionary = dictionary_;
  }

 private:
  std::vector<std::string> inputs() const override { return paths_; }

  CalibrateOutcome calibrate(const Observer& observer) override {
    check_board(board_);
    const std::vector<fs::path> files = image_files(paths_, kMostImages);
    std::vector<BoardView> views;
    std::vector<std::string> not_found;
    std::optional<GrayImage> first, without;
    for (std::size_t i = 0; i < files.size(); ++i) {
      const std::string name = printable(files[i].string(), 200);
      observer.update("finding the board", static_cast<double>(i) / static_cast<double>(files.size()));
      GrayImage image = read_gray_image(files[i]);
      if (first && (image.width != first->width || image.height != first->height)) {
        throw Error(fmt::format("{}: {}x{} px, but {} has {}x{}: all images must be of one camera, uncropped", name,
                                image.width, image.height, printable(files[0].string(), 200), first->width,
                                first->height));
      }
      if (auto view = find_board(image, board_, settings_.find)) {
        view->name = name;
        views.push_back(std::move(*view));
      } else {
        not_found.push_back(name);
        if (!without) without = image;
      }
      if (!first) first = std::move(image);
    }
    if (without && views.size() < static_cast<std::size_t>(settings_.fit.least_views)) refuse_wrong_count(*without);
    observer.update("fitting", 1.0);
    if (views.size() < static_cast<std::size_t>(settings_.fit.least_views) && !not_found.empty()) {
      throw Error(fmt::format(
          "the board was found in {} of {} images (not in {}, for one), at least {} are needed: it must be whole, "
          "sharp and evenly lit, with a white border of a square; check --board {}x{}",
          views.size(), files.size(), not_found.front(), settings_.fit.least_views, board_.columns, board_.rows));
    }
    const CameraFit fit = calibrate_camera(views, first->width, first->height, settings_.fit);
    return describe(fit, not_found);
  }

  // The commonest mistake has a symptom: the board is found if it is counted the other way.
  void refuse_wrong_count(const GrayImage& image) const {
    const CalibrationBoard other = counted_otherwise(board_);
    if (other.inner_columns() < 3 || other.inner_rows() < 3) return;
    std::optional<BoardView> view;
    try {
      view = find_board(image, other, settings_.find);
    } catch (const Error&) {
      return;  // a board that cannot be has not been meant
    }
    if (!view) return;
    throw Error(fmt::format("the images show a board of {}x{} {}: --board counts {}, give --board {}x{}", other.columns,
                            other.rows, charuco_ ? "squares" : "inner corners",
                            charuco_ ? "the squares of a ChArUco board" : "inner corners", other.columns, other.rows));
  }

  CalibrateOutcome describe(const CameraFit& fit, const std::vector<std::string>& not_found) const {
    CalibrateOutcome out;
    const CameraVector value = camera_parameters(fit.camera);
    constexpr const char* kUnits[] = {"px", "px", "px", "px", "", "", "", "", ""};
    for (std::size_t k = 0; k < kCameraParameters; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const bool held = k == 8 && !fit.k3_free;
      out.table.push_back({std::string(kCameraParameterNames[k]), value[i], held ? std::nan("") : fit.standard_error[i],
                           held ? "held" : kUnits[k]});
      if (k >= 4) continue;
      out.values[std::string(kCameraParameterNames[k])] = value[i];
      out.standard_errors[std::string(kCameraParameterNames[k])] = fit.standard_error[i];
    }
    out.values["distortion"] = json_of(value.tail<5>());
    out.standard_errors["distortion"] = json_of(fit.standard_error.tail<5>());
    Json views = Json::array();
    std::size_t corners = 0, used = 0;
    for (const CameraFitView& view : fit.views) {
      views.push_back({{"image", view.name},
                       {"corners", view.corners},
                       {"rms_px", view.rms_px},
                       {"tilt_deg", view.tilt_rad * 180.0 / std::numbers::pi},
                       {"used", view.used}});
      if (!view.used) continue;
      corners += view.corners;
      ++used;
    }
    out.residuals = {{"rms_px", fit.rms_px},
                     {"corner_sigma_px", fit.corner_sigma_px},
                     {"dispersion", fit.dispersion},
                     {"dispersion_stderr", fit.dispersion_error},
                     {"degrees_of_freedom", 2 * corners - (fit.k3_free ? 9 : 8) - 6 * used}};
    out.details = {{"width", fit.camera.width},
                   {"height", fit.camera.height},
                   {"views", views},
                   {"not_found", not_found},
                   {"coverage", fit.coverage},
                   {"steepest_tilt_deg", fit.steepest_tilt_rad * 180.0 / std::numbers::pi},
                   {"k3_over_stderr", fit.k3_over_error},
                   {"covariance", json_of_rows(fit.covariance)}};
    out.table.push_back(
        {"residual RMS", fit.rms_px, std::nan(""), fmt::format("px, {} corners in {} views", corners, used)});
    for (const Problem& problem : fit.problems) out.notes.push_back(problem.message);
    if (!not_found.empty()) {
      out.notes.push_back(fmt::format("no board found in {} image{}, for one {}", not_found.size(),
                                      not_found.size() == 1 ? "" : "s", not_found.front()));
    }
    out.verdict = fit.verdict;
    out.store = [camera = fit.camera](Calibration& calibration) { calibration.camera = camera; };
    return out;
  }

  std::vector<std::string> paths_;
  std::string size_, square_, marker_;
  std::string dictionary_ = "DICT_4X4_50";
  bool charuco_ = false;
  CalibrationBoard board_;
  CameraSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_calibrate_camera(Parser& calibrate) {
  return std::make_unique<CalibrateCameraCommand>(calibrate);
}

}  // namespace asperity::app

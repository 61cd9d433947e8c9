#include <time.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/camera/open_image_folder.h"
#include "asperity/json/config_json.h"
#include "asperity/recording/read_markers.h"
#include "asperity/recording/tracked_body.h"
#include "asperity/session/our_file.h"
#include "asperity/tracking/camera_pose_source.h"
#include "asperity/tracking/track_images.h"
#include "asperity/verdict/verdict_json.h"
#include "commands.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

bool is_image_name(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg" || extension == ".pgm";
}

// The images that are named, those of folders by name.
std::vector<fs::path> list_images(const std::vector<std::string>& named) {
  std::vector<fs::path> out;
  for (const std::string& path : named) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      out.emplace_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
      std::error_code ignored;
      if (is_image_name(entry->path()) && entry->is_regular_file(ignored)) inside.push_back(entry->path());
    }
    if (error) throw Error(printable(path, 200) + ": cannot be read: " + error.message());
    if (inside.empty()) throw Error(printable(path, 200) + ": holds no image (*.png, *.jpg, *.jpeg, *.pgm)");
    std::sort(inside.begin(), inside.end());
    out.insert(out.end(), inside.begin(), inside.end());
  }
  return out;
}

double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class TrackCommand : public Command {
 public:
  explicit TrackCommand(Parser& root)
      : Command(root, "track", "Find the poses of a body of tags in the images of a camera") {
    require(parser().add_option("IMAGES", images_,
                                "Images (PNG, JPEG, PGM), or folders of them, named by their time in ns"));
    require(parser().add_option("--camera", camera_, "A calibration.json with the camera"))->type_name("FILE.json");
    require(
        parser().add_option("--markers", markers_, "Tags of the body: markers.json, or a calibration.json with them"))
        ->type_name("FILE.json");
    parser()
        .add_option("--rate", rate_Hz_, "Images per second; needed where their names are not times")
        ->type_name("HZ");
    parser().add_flag("--timing", timing_, "Print the images per second of one core, reading included");
    require(parser().add_option("-o,--output", output_, "The tracker.csv to write"))->type_name("FILE.csv");
  }

  std::vector<ConfigField> fields() override { return list_fields("track", config_); }

  int run(const Observer& observer) override {
    if (rate_Hz_ && !(*rate_Hz_ > 0.0)) throw UsageError("--rate: must be above 0");
    refuse_stranger(output_, tracked_csv_header(), {camera_, markers_});
    const CameraCalibration camera = read_camera(camera_);
    const MarkerFile markers = read_markers(markers_);
    const std::vector<MarkerPlacement> body = markers_of_body(markers.markers, "");
    const std::vector<std::string> others = bodies_of(markers.markers);
    for (const std::string& other : others)
      refuse_stranger(body_output(other), tracked_csv_header(), {camera_, markers_});
    const std::vector<fs::path> files = list_images(images_);
    ImageFolderConfig images;
    if (rate_Hz_) {
      images.rate_Hz = *rate_Hz_;
    } else {
      for (const fs::path& file : files) {
        if (!parse_int64(file.stem().string())) {
          throw UsageError("the name of " + printable(file.filename().string()) +
                           " is not a time in ns; give the images a --rate");
        }
      }
    }
    const bool one_folder = images_.size() == 1 && fs::is_directory(images_.front());
    const auto open = [&] {
      return one_folder ? open_image_folder(images_.front(), images) : open_image_list(files, images);
    };
    try {
      BodyTracker check(camera, body, config_);
      make_further_trackers(camera, markers.markers, config_);
    } catch (const Error& error) {
      throw Error(markers_ + ": " + error.what());
    }
    const double start_s = processor_s();
    TrackedImages tracked = track_images(open, camera, body, config_, observer, files.size());
    const double frames_per_s = static_cast<double>(tracked.frames) / std::max(1e-9, processor_s() - start_s);
    write_file(output_, format_tracked_csv(tracked.poses));
    std::vector<Followed> followed;
    for (const std::string& other : others) {
      const TrackedImages one =
          track_images(open, camera, markers_of_body(markers.markers, other), config_, observer, files.size());
      write_file(body_output(other), format_tracked_csv(one.poses));
      followed.push_back({other, one.poses.size()});
      for (const Problem& problem : one.problems)
        tracked.problems.push_back({problem.kind, other + ": " + problem.message, problem.count});
      append_verdicts(tracked.verdicts, one.verdicts, other);
    }
    if (!others.empty()) {
      sort_verdicts(tracked.verdicts);
      tracked.trustworthy = is_trustworthy(tracked.verdicts);
      tracked.verdict = verdict_sentence(tracked.verdicts);
    }
    report(tracked, markers.declared, frames_per_s, followed);
    for (const Problem& problem : tracked.problems) print_error("warning: " + problem.message);
    for (const Verdict& verdict : tracked.verdicts) {
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    }
    return tracked.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  // A further body and the images it was found in.
  struct Followed {
    std::string name;
    std::size_t poses = 0;
  };

  // Of a further body: poses.csv becomes poses_object.csv.
  std::string body_output(const std::string& name) const {
    const fs::path whole(output_);
    return (whole.parent_path() / (whole.stem().string() + "_" + name + whole.extension().string())).string();
  }

  static Json numbers(const Eigen::Vector3d& v) {
    if (!v.allFinite()) return nullptr;
    return {v.x(), v.y(), v.z()};
  }

  void report(const TrackedImages& tracked, TagFrame declared, double frames_per_s,
              const std::vector<Followed>& followed) {
    Json out;
    out["format"] = "asperity-tracked";
    out["version"] = 1;
    out["output"] = output_;
    out["frames"] = tracked.frames;
    out["poses"] = tracked.poses.size();
    out["ambiguous"] = tracked.ambiguous;
    for (const Followed& one : followed)
      out["bodies"][one.name] = {{"output", body_output(one.name)}, {"poses", one.poses}};
    if (timing_) out["frames_per_s"] = frames_per_s;
    out["median_reprojection_px"] = tracked.median_reprojection_px;  // null if nan
    out["median_sigma_m"] = numbers(tracked.median_sigma_m);
    out["median_sigma_rad"] = numbers(tracked.median_sigma_rad);
    out["tag_frame_declared"] = name_of(declared);
    out["problems"] = Json::array();
    for (const Problem& problem : tracked.problems) {
      out["problems"].push_back({{"kind", problem.kind}, {"message", problem.message}, {"count", problem.count}});
    }
    out["trustworthy"] = tracked.trustworthy;
    out["verdict"] = tracked.verdict;
    out["verdicts"] = verdicts_json(tracked.verdicts);
    out["config"] = config_json(fields());
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));

    std::string text = fmt::format("{}: the body was found in {} of {} images\n", printable(output_, 200),
                                   tracked.poses.size(), tracked.frames);
    if (!tracked.poses.empty()) {
      text += fmt::format(
          "residual      {:.3f} px\n"
          "sigma         {:.4f}, {:.4f}, {:.4f} mm; {:.4f}, {:.4f}, {:.4f} mrad (median, along and about x, y, z)\n",
          tracked.median_reprojection_px, tracked.median_sigma_m.x() * 1e3, tracked.median_sigma_m.y() * 1e3,
          tracked.median_sigma_m.z() * 1e3, tracked.median_sigma_rad.x() * 1e3, tracked.median_sigma_rad.y() * 1e3,
          tracked.median_sigma_rad.z() * 1e3);
    }
    for (const Followed& one : followed) {
      text += fmt::format("{}: {} was found in {} of {} images\n", printable(body_output(one.name), 200), one.name,
                          one.poses, tracked.frames);
    }
    if (timing_) text += fmt::format("speed         {:.0f} frames/s of one core\n", frames_per_s);
    say(text);
  }

  std::vector<std::string> images_;
  std::string camera_, markers_, output_;
  std::optional<double> rate_Hz_;
  bool timing_ = false;
  TrackConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_track(Parser& root) { return std::make_unique<TrackCommand>(root); }

}  // namespace asperity::app

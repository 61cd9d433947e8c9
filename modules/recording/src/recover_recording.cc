#include "asperity/recording/recover_recording.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/output.h"
#include "asperity/recording/parse_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/recording/tracked_body.h"
#include "asperity/recording/write_recording.h"
#include "block_checksums.h"
#include "recover_stream.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Bodies whose streams are in a folder and that are not among `bodies`, by name: where recording.json is another
// take's.
std::vector<TrackedBody> unlisted_bodies(const fs::path& folder, const std::vector<TrackedBody>& bodies) {
  std::vector<TrackedBody> out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!is_body_file(file)) continue;
    std::string name = file.substr(body_file("").find('.'));
    name.resize(name.find('.'));
    const bool listed =
        std::any_of(bodies.begin(), bodies.end(), [&](const TrackedBody& body) { return body.name == name; });
    if (!listed) out.push_back({name, {}});
  }
  std::sort(out.begin(), out.end(), [](const TrackedBody& a, const TrackedBody& b) { return a.name < b.name; });
  if (out.size() + bodies.size() > kMostBodies) {
    throw Error(folder.string() + ": " + std::to_string(out.size() + bodies.size()) + " bodies, at most " +
                std::to_string(kMostBodies));
  }
  return out;
}

// `parse` of the file, or of the one of `like` where that throws.
template <class Parse>
auto read_or_like(const fs::path& folder, const char* file, const RecoverOptions& options, const ReadLimits& limits,
                  RecoveredRecording& out, const Parse& parse) {
  try {
    if (!inner_file(folder, file)) throw Error((folder / file).string() + ": is a link out of the recording");
    return parse(folder / file, read_file(folder / file, limits.json_bytes));
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    if (options.like.empty()) {
      throw Error(std::string(error.what()) +
                  "; --like REC takes it from another recording of the same probe and tracker");
    }
    out.taken_from_like.emplace_back(file);
    return parse(options.like / file, read_file(options.like / file, limits.json_bytes));
  }
}

void copy_others(const fs::path& folder, const fs::path& to, RecoveredRecording& out) {
  for (const char* name : {"truth.csv", "camera.json", "markers.json", "frames"}) {
    std::error_code error;
    const fs::file_status status = fs::symlink_status(folder / name, error);
    if (error && status.type() != fs::file_type::not_found)
      throw Error((folder / name).string() + ": cannot be read: " + error.message());
    if (!(fs::is_regular_file(status) || fs::is_directory(status))) continue;
    fs::copy(folder / name, to / name, fs::copy_options::recursive | fs::copy_options::skip_symlinks, error);
    if (error) throw Error((folder / name).string() + ": cannot be copied: " + error.message());
    out.copied.emplace_back(name);
  }
}

}  // namespace

Json losses_json(const RecoveredStream& stream) {
  Json out = Json::object();
  out["rows"] = stream.rows;
  out["changed_rows"] = stream.changed_rows;
  out["unreadable_rows"] = stream.unreadable_rows;
  out["rows_missing"] = stream.rows_missing;
  out["header_replaced"] = stream.header_replaced;
  return out;
}

bool RecoveredRecording::lost_nothing() const {
  const auto whole = [](const RecoveredStream& stream) {
    return stream.found && stream.checked && stream.changed_rows == 0 && stream.unreadable_rows == 0 &&
           !stream.rows_missing && !stream.header_replaced;
  };
  return whole(probe) && whole(tracker) && std::all_of(bodies.begin(), bodies.end(), whole) && taken_from_like.empty();
}

RecoveredRecording recover_recording(const fs::path& folder, const fs::path& out, const RecoverOptions& options,
                                     const ReadLimits& limits, const Observer& observer) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) throw Error(folder.string() + ": not a folder");
  RecoveredRecording result;
  RecordingInfo info = read_or_like(folder, "recording.json", options, limits, result,
                                    [&](const fs::path& path, const std::string& text) {
                                      return parse_recording_info(text, path.string(), limits, observer);
                                    });
  // Another take's segments are of other times.
  if (!result.taken_from_like.empty()) {
    info.segments.clear();
    info.recorder.reset();
    info.simulation.reset();
    for (TrackedBody& body : unlisted_bodies(folder, info.bodies)) info.bodies.push_back(std::move(body));
  }
  const Calibration calibration = read_or_like(folder, "calibration.json", options, limits, result,
                                               [&](const fs::path& path, const std::string& text) {
                                                 return parse_calibration(text, path.string(), limits, observer);
                                               });

  std::string checksums;
  if (is_own_file(folder, kChecksumFile)) checksums = read_file(folder / kChecksumFile, limits.json_bytes);
  const std::string probe = recover_stream(folder, "probe.csv", checksums, options, limits, result.probe);
  observer.update("recovering", 0.5);
  const std::string tracker = recover_stream(folder, "tracker.csv", checksums, options, limits, result.tracker);
  std::vector<std::string> body_poses;
  for (const TrackedBody& body : info.bodies) {
    RecoveredStream& stream = result.bodies.emplace_back();
    body_poses.push_back(recover_stream(folder, body_file(body.name), checksums, options, limits, stream));
  }
  if (result.probe.rows == 0 && result.tracker.rows == 0)
    throw Error(folder.string() + ": neither probe.csv nor tracker.csv has a row that can be saved");

  if (!probe.empty()) write_file(out / "probe.csv", probe);
  if (!tracker.empty()) write_file(out / "tracker.csv", tracker);
  std::string new_checksums =
      checksum_header() + checksum_lines("probe.csv", probe) + checksum_lines("tracker.csv", tracker);
  std::vector<TrackedBody> bodies;
  Json body_losses = Json::object();
  for (std::size_t i = 0; i < body_poses.size(); ++i) {
    body_losses[info.bodies[i].name] = losses_json(result.bodies[i]);
    if (body_poses[i].empty()) continue;
    const std::string file = body_file(info.bodies[i].name);
    write_file(out / file, body_poses[i]);
    new_checksums += checksum_lines(file, body_poses[i]);
    bodies.push_back(std::move(info.bodies[i]));
  }
  info.bodies = std::move(bodies);  // without those whose file is lost
  write_file(out / kChecksumFile, new_checksums);
  copy_others(folder, out, result);
  write_calibration(out / "calibration.json", calibration);
  info.extra["recovered"] = {{"probe", losses_json(result.probe)},
                             {"tracker", losses_json(result.tracker)},
                             {"taken_from_another", result.taken_from_like}};
  if (!body_losses.empty()) info.extra["recovered"]["bodies"] = std::move(body_losses);
  write_recording_info(out / "recording.json", info);
  observer.update("recovering", 1.0);
  return result;
}

}  // namespace asperity

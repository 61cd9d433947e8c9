#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/link/probe_description.h"
#include "asperity/recorder/contact_detector.h"
#include "asperity/recorder/gravity_estimator.h"
#include "asperity/recorder/recorder_config.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "asperity/recorder/segment_writer.h"
#include "asperity/recording/recording_appender.h"

namespace asperity {

struct RecorderCommand {
  enum class Kind { kStart, kStop, kDiscard, kRescan, kRestore, kByHand, kByContact };
  Kind kind = Kind::kStart;
  std::string name;
  std::int64_t t_ns = 0;  // when it was asked for
};

// The writing half of the recorder, without its threads and clocks: rows and commands in, files out.
class RecordingWriter {
 public:
  // Makes the folder. Throws Error as RecordingAppender does, and for contact thresholds that contradict.
  RecordingWriter(const std::filesystem::path& folder, RecordingInfo info, const Calibration& calibration,
                  const std::optional<ProbeDescription>& description, bool has_poses, const RecorderConfig& config);

  void add(std::span<const ProbeSample> samples);
  void add(std::span<const TrackerSample> poses);
  void apply(const RecorderCommand& command);
  // It is `now_ns` on the rows' clock: what was to end well before has ended, also if no row comes any more.
  void pass_time(std::int64_t now_ns);
  std::int64_t latest_ns() const { return segments_.latest_ns(); }
  // What the sensors have lost so far, for recording.json.
  void set_problems(std::map<std::string, std::int64_t> problems) { problems_ = std::move(problems); }
  // Told what the probe says of itself now, which may come after the columns were settled.
  void note_description(const std::optional<ProbeDescription>& description);
  // recording.json is to be written at the next commit().
  void note_change() { changed_ = true; }

  // Hands all rows to the operating system. A new recording.json if segments have changed, gravity has been measured,
  // or a change was noted.
  std::optional<RecordingInfo> commit();
  void finish();

  // The parts of a snapshot that are known here.
  void describe(RecorderSnapshot& out) const;

 private:
  RecordingInfo current_info(bool finished) const;
  void touch(const ContactChange& change);
  void begin(std::string name, std::int64_t t_ns);

  RecorderConfig config_;
  RecordingInfo info_;
  std::optional<ProbeDescription> description_;
  std::optional<ForceCalibration> force_;  // nullopt: not calibrated
  ContactDetector contact_;
  GravityEstimator gravity_;
  RecordingAppender appender_;
  SegmentWriter segments_;
  std::map<std::string, std::int64_t> problems_;
  bool changed_ = false;
  bool columns_missing_ = false;
  bool gravity_written_ = false;
  double force_N_ = std::numeric_limits<double>::quiet_NaN();
  std::optional<TrackerSample> pose_;
  std::vector<BodySnapshot> bodies_;
  std::uint64_t touches_ = 0;
  std::uint64_t refused_ = 0;  // segments beyond the most
};

}  // namespace asperity

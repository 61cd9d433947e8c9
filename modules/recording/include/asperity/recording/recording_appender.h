#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// Which optional columns a recording under way has.
struct AppendColumns {
  bool gyro = false;
  bool force3 = false;
  bool markers = false;
  bool reprojection = false;
  bool sigmas = false;  // of each pose
};

struct ProbeSample {
  std::int64_t t_ns = 0;
  Eigen::Vector3d accel_counts = Eigen::Vector3d::Zero();
  double force_counts = std::numeric_limits<double>::quiet_NaN();  // nan: the slower sensor has no new sample
  Eigen::Vector3d gyro_counts = Eigen::Vector3d::Zero();
  Eigen::Vector3d force3_counts = Eigen::Vector3d::Zero();
};

struct TrackerSample {
  std::int64_t t_ns = 0;
  std::size_t body = 0;  // 0: the probe's; k: info.bodies[k − 1] of the recording
  Pose T_world_marker;
  int markers = 0;
  double reprojection_px = std::numeric_limits<double>::quiet_NaN();
  // Standard deviations of translation and of the rotation vector, both along the world's axes; nan: unknown.
  Eigen::Vector3d sigma_position_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d sigma_rotation_rad = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  // The part of them that is of this pose alone, without what all poses of a tracker share (its camera's calibration,
  // the size of its tags); nan: unknown, take the whole.
  Eigen::Vector3d noise_position_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d noise_rotation_rad = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

// Writes a recording while it is made, so that a process or a machine that dies leaves a folder that
// read_recording reads up to the last whole line. The checksums of the streams' blocks go to checksums.txt while they
// are written. Not thread-safe.
class RecordingAppender {
 public:
  // Makes the folder with recording.json and calibration.json, each whole, and the headers of the streams: the
  // probe's, the tracker's and one for each of info.bodies. Throws Error if the folder exists and is not empty: a
  // measurement is never overwritten.
  RecordingAppender(std::filesystem::path folder, const RecordingInfo& info, const Calibration& calibration,
                    const AppendColumns& columns = {});
  ~RecordingAppender();
  RecordingAppender(const RecordingAppender&) = delete;
  RecordingAppender& operator=(const RecordingAppender&) = delete;

  // Keeps whole lines in memory until 64 KiB have gathered or flush() is called.
  void add(const ProbeSample& sample);
  void add(const TrackerSample& sample);

  // Hands all whole lines to the operating system, where the death of this process cannot harm them;
  // with `to_disk`, waits until a power cut cannot either. Throws Error if the disk is full.
  void flush(bool to_disk = false);

  // Flushes to disk, closes the streams and replaces recording.json by `info` with its final segments
  // and problems. With `only_segments` the rows that lie in none of info.segments are taken out of all streams
  // afterwards, each stream replaced by rename. Throws Error if a stream cannot be written; the rows so far
  // remain readable.
  void finish(const RecordingInfo& info, bool only_segments = false);

  // Handed to the operating system so far, of all streams; the lines in memory are not counted.
  std::uint64_t bytes() const;

 private:
  struct Stream;

  // The probe's, the tracker's and the bodies'.
  std::vector<Stream*> streams() const;
  void close() noexcept;
  // Lists the blocks that have ended, all of them if `to_disk`.
  void write_checksums(bool to_disk);

  std::filesystem::path folder_;
  AppendColumns columns_;
  std::unique_ptr<Stream> probe_;
  std::unique_ptr<Stream> tracker_;
  std::vector<std::string> body_files_;
  std::vector<std::unique_ptr<Stream>> bodies_;
  std::unique_ptr<Stream> checksums_;
};

}  // namespace asperity

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/import/align_clocks.h"
#include "asperity/import/check_streams.h"
#include "asperity/import/import_table.h"
#include "asperity/import/pose_noise.h"
#include "asperity/recording/import_imu_pose.h"

namespace asperity {

// Where the streams come from. Without `imu` it is the file of the poses; without `gyro` that of the inertial sensor;
// without `force` whichever of the others has force columns, if any. Without `object` no second body was tracked.
struct ImportFiles {
  std::filesystem::path pose, imu, gyro, force, object;
};

// Both files have the columns that read_imu_pose takes, and there is no other column or file: nothing has to be mapped.
bool has_fixed_columns(const ImportFiles& files);

// The files' tables with what their columns mean.
struct ImportTables {
  std::optional<ImportTable> pose, imu, gyro, force, object;

  std::vector<const ImportTable*> all() const;
};

// Reads and maps them. Throws Error naming file, line and column; Cancelled.
ImportTables read_import_tables(const ImportFiles& files, const MappingConfig& config, const ReadLimits& limits = {},
                                const Observer& observer = {});

// Streams of one body, on one clock, in the recording's axes, and how they came about.
struct ImportedMotion {
  ImportStreams streams;
  PoseStream object;
  StreamChecks checks;
  std::optional<ClockFit> clocks;  // nullopt: the files' times are of one clock
  std::string up;                  // the axis of the files' world that points up
  bool up_is_estimated = false;
  bool up_is_assumed = false;  // estimated from streams that a check has failed for, or from nothing
  double up_angle_rad = 0.0;   // of the mean specific force to it
  std::int64_t start_ns = 0;   // subtracted from the times of files that count from 1970
  PoseNoise noise;             // of the poses, in the recording's axes
};

// Reads the streams, brings them on one clock and into one frame, and checks them. A unit that was guessed from values
// and that the checks contradict is exchanged in `tables`. Doubts that remain are in `checks`. Throws Error as
// read_import_tables, and where times of several files do not overlap and no offset can be found; Cancelled between
// its steps.
ImportedMotion read_imported_motion(ImportTables& tables, const MappingConfig& config, const Observer& observer = {});

// The noise of the poses that a recording is made with, standard deviation an axis, and where it is from: "stated",
// "estimated", or "assumed", 0.05 mm and 1 mrad, where the estimate is lower: a tracker that smooths its poses has
// errors that are not white. "estimated, assumed": the axes differ.
struct TrackerSigma {
  Eigen::Vector3d position_m, rotation_rad;
  std::string position_from, rotation_from;
};
TrackerSigma tracker_sigma(const PoseNoise& noise, const ImportConfig& config);

// A doubt as an error says it: file, columns, their unit, what they look like and what to state.
std::string doubt_text(const ImportDoubt& doubt, const ImportTables& tables, const SettingText& text_of = as_option);

// The recording as import_imu_pose makes it, and
// - the probe's rows are those of the inertial sensor, or of the force where that is faster by more than half; the
// other is
//   filled by straight lines, and force is nan in gaps of more than ten of its intervals;
// - ranges of the 16-bit counts are ±16 g and ±2000 °/s, doubled until all samples fit; force has ±16 N likewise;
// - the tip is at MappingConfig::tip_m; without a gyroscope there is no gyroscope's calibration; three axes of force
// become
//   `force3` with an identity's calibration, one is the force axis;
// - the tracker's noise is what tracker_sigma() has, and calibration.extra.tracker_sigma_from says where from;
// - truth is kept only where poses were thinned or given noise;
// - extra.import_origin has the files, their CRC-32 and the mapping.
// Throws Error if there are no inertial samples or poses.
Recording make_imported_recording(const ImportedMotion& motion, const ImportTables& tables,
                                  const MappingConfig& mapping, const ImportConfig& config);

// The mapping with all columns written out, so that it reads the same files without guessing.
MappingConfig stated_mapping(const ImportTables& tables, const MappingConfig& config, const ImportedMotion& motion);

}  // namespace asperity

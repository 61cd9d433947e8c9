#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include "agree_time_units.h"
#include "asperity/base/error.h"
#include "asperity/import/import_mapped.h"
#include "coverage_notes.h"
#include "lost_poses.h"
#include "world_up.h"

namespace asperity {

namespace {

// The gyroscope's rows put on the accelerometer's times by straight lines; rows without are left out.
void join_gyroscope(ImportStreams& streams, const VectorStream& gyro) {
  if (gyro.t_ns == streams.specific_force.t_ns) {
    streams.rate = gyro;
    return;
  }
  VectorStream force, rate;
  std::size_t row = 0;
  for (std::size_t i = 0; i < streams.specific_force.size(); ++i) {
    const std::int64_t t_ns = streams.specific_force.t_ns[i];
    while (row + 2 < gyro.size() && gyro.t_ns[row + 1] <= t_ns) ++row;
    if (gyro.size() < 2 || t_ns < gyro.t_ns[row] || t_ns > gyro.t_ns[row + 1]) continue;
    const double share =
        static_cast<double>(t_ns - gyro.t_ns[row]) / static_cast<double>(gyro.t_ns[row + 1] - gyro.t_ns[row]);
    force.t_ns.push_back(t_ns);
    force.value.push_back(streams.specific_force.value[i]);
    rate.t_ns.push_back(t_ns);
    rate.value.push_back(lerp(gyro.value[row], gyro.value[row + 1], share));
  }
  if (force.size() == 0) throw Error("the times of the accelerometer and of the gyroscope do not overlap");
  streams.specific_force = std::move(force);
  streams.rate = std::move(rate);
}

// Streams of one file find the same in its times.
void leave_out_repeated(Problems& problems) {
  Problems out;
  for (const Problem& problem : problems) {
    const bool is_known = std::any_of(out.begin(), out.end(), [&](const Problem& p) {
      return p.kind == problem.kind && p.message == problem.message;
    });
    if (!is_known) out.push_back(problem);
  }
  problems = std::move(out);
}

bool has_rates(const ImportTable& table) { return has_group(table.map, ColumnGroup::kRate); }

ImportStreams read_streams(const ImportTables& tables, const MappingConfig& config) {
  ImportStreams out;
  out.pose = read_poses(*tables.pose, config, out.problems);
  out.specific_force = read_vectors(*tables.imu, 'a', out.problems);
  if (tables.gyro) {
    join_gyroscope(out, read_vectors(*tables.gyro, 'g', out.problems));
  } else if (has_rates(*tables.imu)) {
    Problems same_rows;  // as the accelerometer's
    join_gyroscope(out, read_vectors(*tables.imu, 'g', same_rows));
  }
  if (tables.force) {
    if (find_meaning(tables.force->map, "f") != nullptr) {
      out.force = read_scalars(*tables.force, "f", out.problems);
    } else {
      out.force3 = read_vectors(*tables.force, 'f', out.problems);
    }
  }
  std::vector<std::string> files;
  for (const ImportTable* table : tables.all()) {
    if (std::find(files.begin(), files.end(), table->table.file) != files.end()) continue;
    files.push_back(table->table.file);
    out.problems.insert(out.problems.begin(), table->table.problems.begin(), table->table.problems.end());
  }
  leave_out_repeated(out.problems);
  return out;
}

std::string unit_of(const std::optional<ImportTable>& table, const char* meaning, const char* otherwise) {
  const MappedColumn* column = table ? find_meaning(table->map, meaning) : nullptr;
  return column != nullptr ? column->unit : otherwise;
}

StreamUnits units_of_tables(const ImportTables& tables, const MappingConfig& config) {
  const auto& rates = tables.gyro ? tables.gyro : tables.imu;
  return {unit_of(tables.pose, "t", ""),     unit_of(tables.imu, "t", ""),  unit_of(tables.pose, "px", "m"),
          unit_of(tables.imu, "ax", "m/s2"), unit_of(rates, "gx", "rad/s"), sensor_axes(config.imu_axes)};
}

// Whether one of the doubts is over a unit that nobody stated; exchanges it.
bool exchange_guessed_unit(const std::vector<ImportDoubt>& doubts, ImportTables& tables) {
  for (const ImportDoubt& doubt : doubts) {
    if (doubt.unit.empty()) continue;
    ImportTable& table = doubt.role == FileRole::kPose                      ? *tables.pose
                         : doubt.group == ColumnGroup::kRate && tables.gyro ? *tables.gyro
                                                                            : *tables.imu;
    const auto is_meant = [&](const MappedColumn& column) {
      return group_of(column.meaning) == doubt.group && column.meaning != "t2";
    };
    const bool guessed = std::all_of(table.map.begin(), table.map.end(), [&](const MappedColumn& column) {
      return !is_meant(column) || column.unit_why == "by its values";
    });
    if (!guessed) continue;
    if (doubt.group == ColumnGroup::kTime) {
      set_time_unit(tables, table, doubt.unit, "by the other sensor");
      return true;
    }
    for (MappedColumn& column : table.map) {
      if (!is_meant(column)) continue;
      column.unit = doubt.unit;
      column.unit_why = "by the other sensor";
    }
    return true;
  }
  return false;
}

double overlap_s(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  if (a.empty() || b.empty()) return 0.0;
  return static_cast<double>(std::min(a.back(), b.back()) - std::max(a.front(), b.front())) * 1e-9;
}

template <class Stream>
void move_times(Stream& stream, const ClockFit& clocks) {
  for (auto& t_ns : stream.t_ns) t_ns = clocks.imu_time_ns(t_ns);
}

// The axis that points up, or all that may.
std::vector<Eigen::Vector3d> possible_ups(const std::string& up) {
  if (!up.empty()) return {axis_vector(up, "the world's axis that points up")};
  std::vector<Eigen::Vector3d> out;
  for (const char* axis : {"z", "-z", "y", "-y", "x", "-x"}) out.push_back(axis_vector(axis, "up"));
  return out;
}

void put_on_one_clock(const ImportTables& tables, const MappingConfig& config, ImportedMotion& motion) {
  const ClockChoice choice = config.clocks;
  ImportStreams& streams = motion.streams;
  const bool apart = overlap_s(streams.pose.t_ns, streams.specific_force.t_ns) <= 0.0;
  if (choice == ClockChoice::kOne || (choice == ClockChoice::kAuto && !apart)) {
    if (apart) {
      throw Error(
          fmt::format("{} and {}: their times do not overlap", tables.pose->table.file, tables.imu->table.file));
    }
    return;
  }
  motion.clocks = align_clocks(streams.pose, streams.rate, streams.specific_force, possible_ups(up_of(tables, config)));
  if (!motion.clocks->is_determined) {
    const std::string what = apart ? "their times do not overlap, and the" : "the";
    throw Error(fmt::format("{} and {}: {} offset of the clocks is not determined: {}", tables.pose->table.file,
                            tables.imu->table.file, what, motion.clocks->reason));
  }
  const auto is_with_poses = [&](const std::optional<ImportTable>& table) {
    return table && table->table.file == tables.pose->table.file;
  };
  if (is_with_poses(tables.force)) {
    move_times(streams.force, *motion.clocks);
    move_times(streams.force3, *motion.clocks);
  }
  move_times(streams.pose, *motion.clocks);
  move_times(motion.object, *motion.clocks);
}

// Times since 1970 become times since the first whole second: doubles of seconds keep their nanoseconds.
void start_near_zero(ImportedMotion& motion) {
  ImportStreams& s = motion.streams;
  constexpr std::int64_t kEpoch_ns = 1'000'000'000'000'000;  // 11 days
  constexpr std::int64_t kWholeSecond_ns = 1'000'000'000;
  const std::int64_t first = std::min(s.pose.t_ns.front(), s.specific_force.t_ns.front());
  if (std::abs(first) < kEpoch_ns) return;
  motion.start_ns = first / kWholeSecond_ns * kWholeSecond_ns;
  for (auto* times :
       {&s.pose.t_ns, &s.specific_force.t_ns, &s.rate.t_ns, &s.force.t_ns, &s.force3.t_ns, &motion.object.t_ns}) {
    for (auto& t_ns : *times) t_ns -= motion.start_ns;
  }
  if (motion.clocks) motion.clocks->middle_ns -= motion.start_ns;
}

constexpr const char* kEulerOrders[] = {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"};

// The intrinsic order by which the rotations agree best with the gyroscope's, where its disagreement (1 − cosine) is
// less than half of that of `other_cosine`, or, if that is 0, of any other order; "" if none does. `read_in`: the
// clocks of the streams.
std::string better_euler_order(const ImportTables& tables, const MappingConfig& config, const ImportedMotion& read_in,
                               double other_cosine) {
  std::string best;
  double highest = 0.0, next = other_cosine;
  for (const char* order : kEulerOrders) {
    MappingConfig trial = config;
    trial.euler = order;
    trial.euler_axes = EulerAxes::kIntrinsic;
    Problems known;
    PoseStream pose = read_poses(*tables.pose, trial, known);
    if (config.left_handed) mirror_poses(pose, up_of(tables, config));
    if (read_in.clocks) move_times(pose, *read_in.clocks);
    for (auto& t_ns : pose.t_ns) t_ns -= read_in.start_ns;
    const double cosine = rotation_cosine(pose, read_in.streams.rate);
    if (other_cosine == 0.0) next = std::max(next, std::min(cosine, highest));
    if (cosine > highest) {
      highest = cosine;
      best = order;
    }
  }
  constexpr double kOtherFits = 0.9;
  return highest > kOtherFits && 2.0 * (1.0 - highest) < 1.0 - next ? best : "";
}

bool reads_euler_angles(const ImportTables& tables) {
  return find_meaning(tables.pose->map, "rx") != nullptr && find_meaning(tables.pose->map, "qw") == nullptr &&
         find_meaning(tables.pose->map, "m11") == nullptr && find_meaning(tables.pose->map, "vx") == nullptr;
}

void check_euler_order(const ImportTables& tables, const MappingConfig& config, ImportedMotion& motion) {
  if (!reads_euler_angles(tables) || motion.checks.rate_cosine == 0.0) return;
  // The stated order is one of those that are tried, and not better than itself.
  const std::string better = better_euler_order(tables, config, motion, motion.checks.rate_cosine);
  if (better.empty()) return;
  std::erase_if(motion.checks.doubts, [](const ImportDoubt& doubt) { return doubt.group == ColumnGroup::kRotation; });
  motion.checks.doubts.push_back(
      {ColumnGroup::kRotation,
       FileRole::kPose,
       fmt::format("the gyroscope shows another rotation than Euler angles in this order (cosine {:.4f})",
                   motion.checks.rate_cosine),
       {},
       {{"mapping.euler", better}, {"mapping.euler_axes", "intrinsic"}}});
}

// What a doubt says to state may be stated already, and is then what is wrong.
void compare_with_stated(const MappingConfig& config, std::vector<ImportDoubt>& doubts) {
  for (ImportDoubt& doubt : doubts) {
    const std::string path = doubt.settings.empty() ? "" : doubt.settings.front().path;
    if (path == "mapping.invert_rotation" && config.invert_rotation) {
      doubt.message = "the poses and the gyroscope show different rotations; they agree if nothing is inverted";
      doubt.settings.front().value = "false";
    } else if (path == "mapping.imu_axes" && config.left_handed) {
      doubt.left_handed = false;
    } else if (doubt.group == ColumnGroup::kRate && !doubt.axes.empty() && !config.left_handed) {
      doubt.left_handed = true;
    }
  }
}

ImportedMotion read_motion_once(const ImportTables& tables, const MappingConfig& config, const Observer& observer) {
  observer.update("import", 0.3);
  ImportedMotion out;
  out.streams = read_streams(tables, config);
  if (tables.object) out.object = read_poses(*tables.object, config, out.streams.problems);
  if (config.left_handed) {
    mirror_poses(out.streams.pose, up_of(tables, config));
    mirror_poses(out.object, up_of(tables, config));
  }
  turn_sensor(out.streams, sensor_axes(config.imu_axes));
  // Times that cannot be are a doubt before they are compared.
  ImportStreams times;
  times.pose.t_ns = out.streams.pose.t_ns;
  times.specific_force.t_ns = out.streams.specific_force.t_ns;
  out.checks = check_times_only(times, units_of_tables(tables, config));
  if (!out.checks.doubts.empty()) {
    find_up(tables, config, out);
    return out;
  }
  observer.update("import", 0.5);
  put_on_one_clock(tables, config, out);
  start_near_zero(out);
  leave_out_frozen_poses(tables.pose->table.file, out.streams);
  std::vector<std::string> coverage = coverage_notes(tables, out.streams);
  observer.update("import", 0.7);
  out.checks = check_streams(out.streams, units_of_tables(tables, config));
  std::move(coverage.begin(), coverage.end(), std::back_inserter(out.checks.notes));
  check_euler_order(tables, config, out);
  compare_with_stated(config, out.checks.doubts);
  find_up(tables, config, out);
  observer.update("import", 0.9);
  out.noise = estimate_pose_noise(out.streams.pose);
  return out;
}

// The order that nobody states, by the gyroscope. Throws Error if it does not decide.
std::string guess_euler_order(const ImportTables& tables, const MappingConfig& config, const Observer& observer) {
  MappingConfig any = config;
  any.euler = "zyx";
  const ImportedMotion motion = read_motion_once(tables, any, observer);
  const std::string best = motion.streams.rate.size() > 0 ? better_euler_order(tables, any, motion, 0.0) : "";
  if (best.empty()) {
    throw Error(tables.pose->table.file +
                ": the order of the Euler angles is not stated, and the gyroscope does not decide it: state it "
                "(euler), such as zyx, and the unit of the angles where it may not be that of the header");
  }
  return best;
}

// One sensor's three columns have one unit: the checks see its size in all, and would miss a single axis.
void check_units_of_sensors(const ImportTables& tables, std::vector<ImportDoubt>& doubts) {
  const std::array<std::pair<ColumnGroup, FileRole>, 3> sensors{{{ColumnGroup::kPosition, FileRole::kPose},
                                                                 {ColumnGroup::kAcceleration, FileRole::kImu},
                                                                 {ColumnGroup::kRate, FileRole::kImu}}};
  for (const auto& [group, role] : sensors) {
    const ImportTable& table = role == FileRole::kPose                      ? *tables.pose
                               : group == ColumnGroup::kRate && tables.gyro ? *tables.gyro
                                                                            : *tables.imu;
    std::vector<std::string> units;
    for (const MappedColumn& column : table.map) {
      if (group_of(column.meaning) != group) continue;
      if (std::find(units.begin(), units.end(), column.unit) == units.end()) units.push_back(column.unit);
    }
    if (units.size() < 2) continue;
    std::string names;
    for (const std::string& unit : units) names += (names.empty() ? "" : " and ") + unit;
    doubts.push_back({group, role, "the axes of one sensor are read in different units, " + names, {}, {}});
  }
}

// Files on one clock, by their times: the rotation shows where they are not. Their offset is noted, not corrected.
void note_offset(const ImportTables& tables, const MappingConfig& config, ImportedMotion& motion) {
  const bool one_file = tables.pose->table.file == (tables.gyro ? *tables.gyro : *tables.imu).table.file;
  if (motion.clocks || one_file || motion.streams.rate.size() == 0 || !motion.checks.doubts.empty()) return;
  const ClockFit fit = align_clocks(motion.streams.pose, motion.streams.rate, {}, possible_ups(up_of(tables, config)));
  constexpr double kLeast_s = 0.01, kSigmas = 5.0;
  if (!fit.is_determined || std::abs(fit.offset_s) < std::max(kLeast_s, kSigmas * fit.offset_sigma_s)) return;
  motion.checks.notes.push_back(
      fmt::format("clocks: the rotations agree best with the poses {:.4f} ± {:.4f} s {}; --clocks separate moves them",
                  std::abs(fit.offset_s), fit.offset_sigma_s, fit.offset_s > 0.0 ? "later" : "earlier"));
}

}  // namespace

ImportedMotion read_imported_motion(ImportTables& tables, const MappingConfig& config, const Observer& observer) {
  agree_time_units(tables);
  if (config.euler.empty() && tables.pose->preset.euler.empty() && reads_euler_angles(tables)) {
    tables.pose->preset.euler = guess_euler_order(tables, config, observer);
  }
  ImportedMotion out = read_motion_once(tables, config, observer);
  constexpr int kMostExchanges = 6;
  for (int i = 0; i < kMostExchanges && exchange_guessed_unit(out.checks.doubts, tables); ++i) {
    out = read_motion_once(tables, config, observer);
  }
  check_units_of_sensors(tables, out.checks.doubts);
  note_offset(tables, config, out);
  return out;
}

}  // namespace asperity

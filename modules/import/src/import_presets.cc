#include "asperity/import/import_presets.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include "asperity/base/error.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

bool has_name(const DelimitedTable& table, std::string_view name) {
  return std::any_of(table.columns.begin(), table.columns.end(), [&](const auto& c) { return c.name == name; });
}

void add_number(ColumnMap& map, const std::string& meaning, std::size_t column, const std::string& unit) {
  map.push_back({meaning, column, unit, false, {}, {}});
}

// `meanings` one after the other from a column on.
void add_run(ColumnMap& map, std::initializer_list<const char*> meanings, std::size_t first, const std::string& unit) {
  for (const char* meaning : meanings) add_number(map, meaning, first++, unit);
}

// OptiTrack Motive's CSV: pairs of key and value in line 1, then Type, Name, ID and Rotation or Position above the
// axes.
bool is_motive(const DelimitedTable& table) { return !table.preface_value("Rotation Type").empty(); }

void fill_motive(const DelimitedTable& table, FileRole, FilePreset& out) {
  out.length = table.preface_value("Length Units");
  if (out.length.empty()) out.length = "m";
  out.up = "y";
  const std::string rotation = table.preface_value("Rotation Type");
  if (rotation.size() == 3) {
    for (const char c : rotation) out.euler += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
}

// Vicon's: a section's name, its rate, subjects, axes, units. Rotations are vectors (axis times angle) or quaternions.
constexpr std::array<std::string_view, 4> kNexusSections{"Segments", "Trajectories", "Devices", "Model Outputs"};

bool has_vicon_section(const DelimitedTable& table, std::string_view section) {
  if (!has_name(table, "Sub Frame")) return false;
  return std::any_of(table.preface.begin(), table.preface.end(),
                     [&](const std::string& line) { return line.starts_with(section); });
}
bool is_tracker(const DelimitedTable& table) { return has_vicon_section(table, "Objects"); }
bool is_nexus(const DelimitedTable& table) {
  // Read from its section on, the section's name is not in the preface, but its rate is.
  return has_name(table, "Sub Frame") && !is_tracker(table);
}

void fill_vicon(const DelimitedTable& table, FileRole role, FilePreset& out) {
  out.up = "z";
  for (const std::string& line : table.preface) {
    std::string_view bare = line;
    while (bare.ends_with(',')) bare.remove_suffix(1);
    if (const auto rate = parse_double(bare); rate && *rate > 0.0) out.rate_Hz = *rate;
  }
  if (role != FileRole::kPose || has_name(table, "RW")) return;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const DelimitedColumn& column = table.columns[i];
    if (column.name != "RX" || i + 2 >= table.columns.size()) continue;
    const std::string unit = column.unit.empty() ? "rad" : column.unit;
    add_run(out.map, {"vx", "vy", "vz"}, i, find_import_unit(unit, Quantity::kAngle) ? unit : "rad");
    return;
  }
}

// Qualisys Track Manager's TSV with 6D data: keys and values, then X Y Z Roll Pitch Yaw Residual Rot[0] … Rot[8], the
// matrix column by column.
bool is_qualisys(const DelimitedTable& table) { return !table.preface_value("NO_OF_FRAMES").empty(); }

void fill_qualisys(const DelimitedTable& table, FileRole role, FilePreset& out) {
  out.length = "mm";
  if (const auto rate = parse_double(table.preface_value("FREQUENCY"))) out.rate_Hz = *rate;
  if (role != FileRole::kPose) return;
  for (std::size_t i = 0; i + 8 < table.columns.size(); ++i) {
    const DelimitedColumn& column = table.columns[i];
    if (!column.name.ends_with("Rot") || column.unit != "0") continue;
    add_run(out.map, {"m11", "m21", "m31", "m12", "m22", "m32", "m13", "m23", "m33"}, i, "1");
    return;
  }
}

// The trajectories of the TUM RGB-D benchmark: timestamp tx ty tz qx qy qz qw.
bool is_tum(const DelimitedTable& table) {
  constexpr std::size_t kColumns = 8;
  if (table.columns.size() != kColumns || table.separator != ' ') return false;
  if (table.has_header()) return has_name(table, "tx") && has_name(table, "qw");
  for (const std::size_t row : {std::size_t{0}, table.rows() / 2, table.rows() - 1}) {
    double square = 0.0;
    for (std::size_t i = 4; i < kColumns; ++i) square += std::pow(table.columns[i].values[row], 2);
    constexpr double kRounding = 0.02;
    if (!(std::abs(square - 1.0) < kRounding)) return false;
  }
  return true;
}

void fill_tum(const DelimitedTable&, FileRole, FilePreset& out) {
  add_number(out.map, "t", 0, "s");
  add_run(out.map, {"px", "py", "pz"}, 1, "m");
  add_run(out.map, {"qx", "qy", "qz", "qw"}, 4, "1");
}

// The EuRoC MAV data set's imu0/data.csv and state_groundtruth_estimate0/data.csv.
bool is_euroc(const DelimitedTable& table) { return has_name(table, "w_RS_S_x") || has_name(table, "p_RS_R_x"); }

void fill_euroc(const DelimitedTable&, FileRole, FilePreset& out) {
  add_number(out.map, "t", 0, "ns");
  out.length = "m";
}

// `ros2 topic echo --csv` of geometry_msgs/PoseStamped and sensor_msgs/Imu: sec, nanosec, frame_id, then the fields.
constexpr std::size_t kRosPoseColumns = 10;
constexpr std::size_t kRosImuColumns = 40;

bool is_ros2(const DelimitedTable& table) {
  const std::size_t columns = table.columns.size();
  return !table.has_header() && table.separator == ',' && (columns == kRosPoseColumns || columns == kRosImuColumns) &&
         !table.columns[0].has_text && !table.columns[1].has_text && !std::isfinite(table.columns[2].values.front());
}

void fill_ros2(const DelimitedTable& table, FileRole, FilePreset& out) {
  add_number(out.map, "t", 0, "s");
  add_number(out.map, "t2", 1, "ns");
  if (table.columns.size() == kRosPoseColumns) {
    add_run(out.map, {"px", "py", "pz"}, 3, "m");
    add_run(out.map, {"qx", "qy", "qz", "qw"}, 6, "1");
  } else {
    constexpr std::size_t kCovariance = 9;
    add_run(out.map, {"gx", "gy", "gz"}, 3 + 4 + kCovariance, "rad/s");
    add_run(out.map, {"ax", "ay", "az"}, 3 + 4 + kCovariance + 3 + kCovariance, "m/s2");
  }
}

// `rostopic echo -p -b FILE.bag TOPIC` of ROS 1: %time is when the bag got the message, the header's stamp when it was
// measured. A driver that does not stamp leaves zeros.
std::size_t ros1_stamp(const DelimitedTable& table) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].name == "field.header.stamp") return i;
  }
  return table.columns.size();
}

bool is_ros1(const DelimitedTable& table) { return ros1_stamp(table) < table.columns.size(); }

void fill_ros1(const DelimitedTable& table, FileRole, FilePreset& out) {
  const std::size_t stamp = ros1_stamp(table);
  const std::vector<double>& stamps = table.columns[stamp].values;
  if (!stamps.empty() && stamps.front() != stamps.back()) add_number(out.map, "t", stamp, "ns");
}

// The app Sensor Logger: a file a sensor, its name says which; time in ns since 1970.
bool is_sensor_logger(const DelimitedTable& table) { return has_name(table, "seconds_elapsed"); }

void fill_sensor_logger(const DelimitedTable& table, FileRole, FilePreset& out) {
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].name == "time") return add_number(out.map, "t", i, "ns");
  }
}

// The app phyphox: "Time (s)", "Acceleration x (m/s^2)", …
bool is_phyphox(const DelimitedTable& table) {
  return has_name(table, "Acceleration x") || has_name(table, "Gyroscope x") ||
         has_name(table, "Linear Acceleration x");
}

struct Preset {
  const char* name;
  bool (*is_its)(const DelimitedTable&);
  void (*fill)(const DelimitedTable&, FileRole, FilePreset&);
};

constexpr Preset kPresets[] = {
    {"motive", is_motive, fill_motive},
    {"vicon-tracker", is_tracker, fill_vicon},
    {"vicon-nexus", is_nexus, fill_vicon},
    {"qualisys", is_qualisys, fill_qualisys},
    {"euroc", is_euroc, fill_euroc},
    {"tum", is_tum, fill_tum},
    {"ros1", is_ros1, fill_ros1},
    {"ros2", is_ros2, fill_ros2},
    {"sensor-logger", is_sensor_logger, fill_sensor_logger},
    {"phyphox", is_phyphox, nullptr},
};

FilePreset filled_preset(const Preset& preset, const DelimitedTable& table, FileRole role) {
  FilePreset out;
  out.name = preset.name;
  if (preset.fill != nullptr) preset.fill(table, role, out);
  for (MappedColumn& column : out.map) column.why = column.unit_why = "preset " + out.name;
  return out;
}

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> out;
  for (const Preset& preset : kPresets) out.emplace_back(preset.name);
  return out;
}

FilePreset find_preset(const DelimitedTable& table, FileRole role, const std::string& name) {
  if (name == "none") return {};
  for (const Preset& preset : kPresets) {
    const bool wanted = name == preset.name;
    if (!name.empty() && !wanted) continue;
    if (preset.is_its(table)) return filled_preset(preset, table, role);
    if (wanted) throw Error(fmt::format("{}: does not look like a file of '{}'", table.file, name));
  }
  if (name.empty()) return {};
  std::string known;
  for (const Preset& preset : kPresets) known += std::string(known.empty() ? "" : ", ") + preset.name;
  throw Error(fmt::format("preset '{}' is not known: {}, none", printable(name), known));
}

std::string preset_section(const std::string& text, FileRole role) {
  const std::string_view first_line = trim(std::string_view(text).substr(0, text.find('\n')));
  bool is_vicon = first_line.starts_with("Objects");
  for (const std::string_view section : kNexusSections) is_vicon = is_vicon || first_line.starts_with(section);
  if (!is_vicon) return {};
  const auto has_line = [&](const std::string& word) {
    return text.starts_with(word) || text.find("\n" + word) != std::string::npos;
  };
  const std::string wanted = role != FileRole::kPose ? "Devices" : has_line("Segments") ? "Segments" : "Objects";
  return first_line.starts_with(wanted) || !has_line(wanted) ? "" : wanted;
}

}  // namespace asperity

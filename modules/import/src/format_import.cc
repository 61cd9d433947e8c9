#include "asperity/import/format_import.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include "asperity/base/text.h"

namespace asperity {

namespace {

struct ValueRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

ValueRange range_of(const DelimitedColumn& column) {
  ValueRange out;
  for (const double value : column.values) {
    if (!std::isfinite(value)) continue;
    out.low = std::min(out.low, value);
    out.high = std::max(out.high, value);
  }
  return out;
}

std::string column_name(const ImportTable& table, const MappedColumn& column) {
  const DelimitedColumn& found = table.table.columns[column.column];
  constexpr std::size_t kLongest = 24;
  // Of a long label the end says what it is.
  const std::string label = found.label().size() <= kLongest ? found.label() : found.name;
  return fmt::format("#{}{}", column.column + 1, label.empty() ? "" : " " + printable(label, kLongest));
}

std::string why_text(const MappedColumn& column) {
  if (column.unit_why.empty() || column.unit_why == column.why) return column.why;
  return column.why + ", unit " + column.unit_why;
}

}  // namespace

std::string unused_columns_text(const std::vector<const ImportTable*>& tables) {
  std::string out;
  for (const UnusedColumns& unused : unused_columns(tables)) {
    out += fmt::format("not used    {}: {}\n", printable(unused.table->table.file, 200),
                       column_list(unused.table->table, unused.columns));
  }
  return out;
}

Json unused_columns_json(const std::vector<const ImportTable*>& tables) {
  Json out = Json::array();
  for (const UnusedColumns& unused : unused_columns(tables)) {
    Json columns = Json::array();
    for (const std::size_t i : unused.columns)
      columns.push_back({{"number", i + 1}, {"name", unused.table->table.columns[i].label()}});
    out.push_back({{"file", unused.table->table.file}, {"columns", std::move(columns)}});
  }
  return out;
}

std::string import_table_text(const ImportTables& tables) {
  std::string out;
  for (const ImportTable* table : tables.all()) {
    out += fmt::format("{}: {}{}, {} rows{}\n", printable(table->table.file, 200), role_name(table->role),
                       table->preset.name.empty() ? "" : " (" + table->preset.name + ")", table->table.rows(),
                       table->rate_Hz > 0.0 ? fmt::format(" at {:.6g} Hz", table->rate_Hz) : std::string());
    out += fmt::format("  {:<7} {:<28} {:<8} {:<22} {:<26} {}\n", "meaning", "column", "unit", "first", "range", "why");
    for (const MappedColumn& column : table->map) {
      const DelimitedColumn& values = table->table.columns[column.column];
      const ValueRange range = range_of(values);
      out += fmt::format("  {:<7} {:<28} {:<8} {:<22} {:<26} {}\n", (column.negative ? "-" : "") + column.meaning,
                         column_name(*table, column), column.unit, printable(table->table.cell(0, column.column), 22),
                         range.low <= range.high ? fmt::format("{:.6g} to {:.6g}", range.low, range.high) : "text",
                         why_text(column));
    }
  }
  return out + unused_columns_text(tables.all());
}

std::string import_summary_text(const ImportTables& tables) {
  std::string out;
  for (const ImportTable* table : tables.all()) {
    out += fmt::format("{} ({}{}):", printable(table->table.file, 200), role_name(table->role),
                       table->preset.name.empty() ? "" : ", " + table->preset.name);
    for (const MappedColumn& column : table->map) {
      out += fmt::format(" {}={}{}", column.meaning, column.negative ? "-" : "", column_name(*table, column));
      if (column.unit != "1") out += "[" + column.unit + "]";
    }
    if (table->rate_Hz > 0.0) out += fmt::format(" at {:.6g} Hz", table->rate_Hz);
    out += "\n";
  }
  return out + unused_columns_text(tables.all());
}

std::string import_checks_text(const ImportedMotion& motion) {
  std::string out;
  constexpr double kDegrees = 57.29577951308232;
  if (!motion.up.empty()) {
    const bool is_axis = !motion.up.starts_with('(');
    out += fmt::format("world       {} points up ({}; the mean specific force is {:.1f}° from {})\n", motion.up,
                       motion.up_is_assumed     ? "not stated, assumed"
                       : motion.up_is_estimated ? "by the specific force"
                                                : "stated",
                       motion.up_angle_rad * kDegrees, is_axis ? "it" : "the nearest axis");
  }
  const StreamChecks& checks = motion.checks;
  if (checks.rest_mps2 > 0.0) out += fmt::format("gravity     {:.3f} m/s²\n", checks.rest_mps2);
  if (checks.rate_ratio > 0.0) {
    out += fmt::format("rotation    gyroscope {:.3f} times the poses', cosine {:.3f} (means over {:.0f} ms)\n",
                       checks.rate_ratio, checks.rate_cosine, 1e3 * checks.rate_stretch_s);
  }
  if (checks.scale > 0.0) out += fmt::format("lengths     poses {:.3f} times the accelerometer's\n", checks.scale);
  if (motion.clocks && motion.clocks->is_determined) {
    const ClockFit& clocks = *motion.clocks;
    out += fmt::format("clocks      poses + {:.6f} ± {:.6f} s", clocks.offset_s, clocks.offset_sigma_s);
    out += clocks.drift_sigma > 0.0
               ? fmt::format(", drift {:.2f} ± {:.2f} ppm", clocks.drift * 1e6, clocks.drift_sigma * 1e6)
               : std::string(", drift not determined (too short)");
    out += fmt::format(", by the {}, correlation {:.3f}\n", clocks.by, clocks.correlation);
  }
  for (const std::string& note : checks.notes) out += "note        " + note + "\n";
  return out;
}

std::string tracker_sigma_text(const TrackerSigma& sigma) {
  const auto axes = [](const Eigen::Vector3d& value) {
    const Eigen::Vector3d milli = 1e3 * value;
    return milli.x() == milli.y() && milli.y() == milli.z()
               ? fmt::format("{:.2g}", milli.x())
               : fmt::format("{:.2g}, {:.2g}, {:.2g}", milli.x(), milli.y(), milli.z());
  };
  const bool same = sigma.position_from == sigma.rotation_from;
  std::string out =
      fmt::format("noise       a pose's position {} mm{}, rotation {} mrad ({})\n", axes(sigma.position_m),
                  same ? "" : " (" + sigma.position_from + ")", axes(sigma.rotation_rad), sigma.rotation_from);
  return out;
}

Json import_json(const ImportTables& tables, const ImportedMotion& motion) {
  Json out;
  out["files"] = Json::array();
  for (const ImportTable* table : tables.all()) {
    Json file;
    file["file"] = table->table.file;
    file["role"] = role_name(table->role);
    file["preset"] = table->preset.name;
    file["rows"] = table->table.rows();
    file["rate_hz"] = table->rate_Hz;
    file["columns"] = Json::array();
    for (const MappedColumn& column : table->map) {
      const ValueRange range = range_of(table->table.columns[column.column]);
      file["columns"].push_back({{"meaning", column.meaning},
                                 {"number", column.column + 1},
                                 {"name", table->table.columns[column.column].label()},
                                 {"unit", column.unit},
                                 {"negative", column.negative},
                                 {"why", why_text(column)},
                                 {"first", std::string(table->table.cell(0, column.column))},
                                 {"low", range.low},
                                 {"high", range.high}});
    }
    out["files"].push_back(std::move(file));
  }
  out["unused"] = unused_columns_json(tables.all());
  out["up"] = motion.up;
  out["gravity_mps2"] = motion.checks.rest_mps2;
  out["rate_ratio"] = motion.checks.rate_ratio;
  out["rate_cosine"] = motion.checks.rate_cosine;
  out["scale"] = motion.checks.scale;
  out["rate_stretch_s"] = motion.checks.rate_stretch_s;
  out["pose_noise_m"] = {motion.noise.position_m.x(), motion.noise.position_m.y(), motion.noise.position_m.z()};
  out["pose_noise_rad"] = {motion.noise.rotation_rad.x(), motion.noise.rotation_rad.y(), motion.noise.rotation_rad.z()};
  out["doubts"] = Json::array();
  for (const ImportDoubt& doubt : motion.checks.doubts) out["doubts"].push_back(doubt_text(doubt, tables));
  if (motion.clocks) {
    out["clocks"] = {{"determined", motion.clocks->is_determined},
                     {"by", motion.clocks->by},
                     {"offset_s", motion.clocks->offset_s},
                     {"offset_sigma_s", motion.clocks->offset_sigma_s},
                     {"drift", motion.clocks->drift},
                     {"drift_sigma", motion.clocks->drift_sigma}};
  }
  return out;
}

}  // namespace asperity

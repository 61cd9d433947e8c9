#include "add/import_plan.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "asperity/base/config.h"
#include "asperity/base/text.h"
#include "asperity/import/format_import.h"
#include "asperity/import/read_delimited.h"
#include "asperity/studio/calls.h"

namespace asperity::studio {

namespace {

constexpr std::size_t kShownRows = 6;
constexpr std::size_t kLongestCell_bytes = 60;

const Json& member(const Json& args, const char* name) {
  const Json* const found = args.find(name);
  if (found == nullptr || !found->is_object()) throw Error(std::string(name) + ": is not an object");
  return *found;
}

std::filesystem::path file_of(const Project& project, const Json& files, const char* role) {
  const Json* const name = files.find(role);
  if (name == nullptr || (name->is_string() && name->text().empty())) return {};
  if (!name->is_string()) throw Error(std::string("files.") + role + ": is not a name");
  return project.existing(name->text());
}

Json column_rows(const DelimitedTable& table) {
  Json out = Json::array();
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    out.push_back({{"number", i + 1},
                   {"label", printable(table.columns[i].label(), kLongestCell_bytes)},
                   {"unit", printable(table.columns[i].unit, kLongestCell_bytes)}});
  }
  return out;
}

Json cell_rows(const DelimitedTable& table) {
  Json out = Json::array();
  for (std::size_t row = 0; row < std::min(kShownRows, table.rows()); ++row) {
    Json cells = Json::array();
    for (std::size_t column = 0; column < table.columns.size(); ++column)
      cells.push_back(printable(std::string(table.cell(row, column)), kLongestCell_bytes));
    out.push_back(std::move(cells));
  }
  return out;
}

Json table_json(const DelimitedTable& table, FileRole role) {
  return {{"role", role_name(role)},
          {"file", std::filesystem::path(table.file).filename().string()},
          {"preset", ""},
          {"rows", table.rows()},
          {"rate_hz", 0.0},
          {"columns", column_rows(table)},
          {"cells", cell_rows(table)},
          {"map", Json::array()}};
}

Json table_json(const ImportTable& table) {
  Json out = table_json(table.table, table.role);
  out["preset"] = table.preset.name;
  out["rate_hz"] = table.rate_Hz;
  for (const MappedColumn& column : table.map) {
    std::string why = column.why;
    if (!column.unit_why.empty() && column.unit_why != why) why += ", unit " + column.unit_why;
    out["map"].push_back({{"meaning", column.meaning},
                          {"number", column.column + 1},
                          {"unit", column.unit},
                          {"negative", column.negative},
                          {"why", why}});
  }
  return out;
}

// Without their meanings: what the files hold is shown where it could not be understood.
Json plain_tables(const ImportFiles& files) {
  Json out = Json::array();
  const std::pair<const std::filesystem::path&, FileRole> roles[] = {{files.pose, FileRole::kPose},
                                                                     {files.imu, FileRole::kImu},
                                                                     {files.gyro, FileRole::kGyro},
                                                                     {files.force, FileRole::kForce}};
  for (const auto& [path, role] : roles) {
    if (!path.empty()) out.push_back(table_json(read_delimited_file(path), role));
  }
  return out;
}

}  // namespace

ImportChoice import_choice(const Project& project, const Json& args) {
  const Json& files = member(args, "files");
  ImportChoice out;
  out.files = {file_of(project, files, "pose"), file_of(project, files, "imu"), file_of(project, files, "gyro"),
               file_of(project, files, "force"), file_of(project, files, "object")};
  const std::vector<ConfigField> fields = list_fields("mapping", out.mapping);
  const Json& settings = member(args, "settings");
  for (const auto& [path, value] : settings.items()) {
    if (!value.is_string()) throw Error(path + ": is not text");
    const ConfigField& field = find_field(fields, path);
    // Texts as they are: they hold what set_text would take for quotes and lists.
    if (field.type == FieldType::kText) {
      field.set(value.get<std::string>());
    } else {
      field.set_text(value.get<std::string>());
    }
  }
  if (out.files.pose.empty()) {
    throw Advice("no file with poses is chosen", "Choose the file with the tracker's positions and rotations.");
  }
  return out;
}

// With the setting that the reader states.
std::string with_example(const UnstatedSetting& unstated) {
  constexpr std::string_view kSection = "mapping.";
  std::string_view path = unstated.example().path;
  if (path.starts_with(kSection)) path.remove_prefix(kSection.size());
  return std::string(unstated.what()) + ", as " + std::string(path) + " = " + unstated.example().value;
}

Json import_plan(const ImportChoice& choice) {
  Json out{{"files", Json::array()}, {"checks", ""}, {"doubts", Json::array()}, {"fault", ""}};
  try {
    ImportTables tables = read_import_tables(choice.files, choice.mapping);
    for (const ImportTable* table : tables.all()) out["files"].push_back(table_json(*table));
    const ImportedMotion motion = read_imported_motion(tables, choice.mapping);
    out["files"] = Json::array();  // a check may have exchanged a unit
    for (const ImportTable* table : tables.all()) out["files"].push_back(table_json(*table));
    out["checks"] = import_checks_text(motion) + tracker_sigma_text(tracker_sigma(motion.noise, {}));
    for (const ImportDoubt& doubt : motion.checks.doubts) out["doubts"].push_back(doubt_text(doubt, tables));
  } catch (const UnstatedSetting& unstated) {
    out["fault"] = with_example(unstated);
  } catch (const Error& error) {
    out["fault"] = error.what();
  }
  if (out["files"].size() == 0) out["files"] = plain_tables(choice.files);
  return out;
}

Recording import_recording(const ImportChoice& choice) {
  ImportTables tables = read_import_tables(choice.files, choice.mapping);
  const ImportedMotion motion = read_imported_motion(tables, choice.mapping);
  if (!motion.checks.doubts.empty()) {
    throw Advice(doubt_text(motion.checks.doubts.front(), tables), "State the column's meaning or its unit.");
  }
  return make_imported_recording(motion, tables, choice.mapping, ImportConfig{});
}

}  // namespace asperity::studio

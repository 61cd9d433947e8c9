#include "asperity/batch/batch_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/html_text.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

enum class Source { kProcess, kTexture, kRegistration };

// A value of a result: its column, and its place in the file, members separated by blanks.
struct Column {
  std::string_view name;
  Source source;
  std::string_view place;
  std::string_view only_if = {};  // the member that must be true
};

constexpr std::array kColumns{
    Column{"length_m", Source::kProcess, "profile length_m"},
    Column{"length_stderr_m", Source::kProcess, "profile length_stderr_m"},
    Column{"covered", Source::kProcess, "profile covered"},
    Column{"speed_mps", Source::kProcess, "speed_mps mean"},
    Column{"noise_rms_m", Source::kProcess, "profile noise_rms_m"},
    Column{"snr", Source::kProcess, "profile snr"},
    Column{"at_most_m", Source::kProcess, "profile at_most_m"},
    Column{"Ra_m", Source::kProcess, "roughness Ra_m"},
    Column{"Ra_stderr_m", Source::kProcess, "roughness Ra_stderr_m"},
    Column{"Rq_m", Source::kProcess, "roughness Rq_m"},
    Column{"Rq_stderr_m", Source::kProcess, "roughness Rq_stderr_m"},
    Column{"Rz_m", Source::kProcess, "roughness Rz_m"},
    Column{"Rz_stderr_m", Source::kProcess, "roughness Rz_stderr_m"},
    Column{"RSm_m", Source::kProcess, "roughness RSm_m"},
    Column{"RSm_stderr_m", Source::kProcess, "roughness RSm_stderr_m"},
    Column{"pitch_m", Source::kProcess, "periodicity pitch_m", "periodicity periodic"},
    Column{"pitch_stderr_m", Source::kProcess, "periodicity pitch_stderr_m", "periodicity periodic"},
    Column{"depth_m", Source::kProcess, "periodicity depth_m", "periodicity periodic"},
    Column{"depth_stderr_m", Source::kProcess, "periodicity depth_stderr_m", "periodicity periodic"},
    Column{"k_c", Source::kProcess, "compliance k_c", "compliance determined"},
    Column{"k_c_low", Source::kProcess, "compliance k_c_low", "compliance determined"},
    Column{"k_c_high", Source::kProcess, "compliance k_c_high", "compliance determined"},
    Column{"stiffness_N_per_mm", Source::kProcess, "stiffness stiffness_N_per_mm", "stiffness measured"},
    Column{"stiffness_stderr_N_per_mm", Source::kProcess, "stiffness stiffness_stderr_N_per_mm", "stiffness measured"},
    Column{"friction", Source::kProcess, "friction coefficient", "friction determined"},
    Column{"friction_stderr", Source::kProcess, "friction coefficient_stderr", "friction determined"},
    Column{"texture_model", Source::kTexture, "model"},
    Column{"registration_valid", Source::kRegistration, "trustworthy"},
    Column{"registration_rms_m", Source::kRegistration, "rms_m"},
};

constexpr std::uint64_t kLargestResult_bytes = 64 << 20;

Json read_result(const fs::path& file) { return parse_json(read_file(file, kLargestResult_bytes), file.string()); }

// A step of that name, or of that name for one segment ("texture SEGMENT"), was done.
bool was_done(const ScanRecord& record, const std::string& step) {
  return std::any_of(record.steps.begin(), record.steps.end(),
                     [&](const StepRecord& one) { return one.name == step && one.is_done(); });
}

const Json* find_place(const Json& json, std::string_view place) {
  const Json* at = &json;
  while (at != nullptr && !place.empty()) {
    const std::size_t blank = place.find(' ');
    at = at->find(place.substr(0, blank));
    place = blank == std::string_view::npos ? "" : place.substr(blank + 1);
  }
  return at;
}

std::string cell_of(const Json& json, const Column& column) {
  if (!column.only_if.empty()) {
    const Json* condition = find_place(json, column.only_if);
    if (condition == nullptr || !condition->is_boolean() || !condition->get<bool>()) return "";
  }
  const Json* value = find_place(json, column.place);
  if (value == nullptr) return "";
  if (value->is_number()) return number_text(value->get<double>());
  if (value->is_string()) return value->text();
  if (value->is_boolean()) return value->get<bool>() ? "true" : "false";
  return "";
}

int badness(std::string_view status) { return status == "invalid" ? 2 : status == "limited" ? 1 : 0; }

// Lowers the row's status to `status` if that is worse, with its message.
void lower(SummaryRow& row, const std::string& status, const std::string& message) {
  if (badness(status) <= badness(row.status)) return;
  row.status = status;
  row.message = message;
}

// The verdicts of a result; `prefix` stands before their messages. False if it has no list of them.
bool add_verdicts(const Json& result, const std::string& prefix, SummaryRow& row) {
  const Json* verdicts = result.find("verdicts");
  if (verdicts == nullptr || !verdicts->is_array()) return false;
  for (const Json& verdict : verdicts->list()) {
    const auto severity = verdict.value<std::string>("severity", "note");
    row.codes.push_back(severity + ":" + verdict.value<std::string>("code", "?"));
    lower(row, severity, prefix + verdict.value<std::string>("message", ""));
  }
  return true;
}

// The row of one result of process. Throws Error naming the file for one that is missing or damaged.
SummaryRow row_of_piece(const ScanRecord& record, const fs::path& results, const std::string& piece, SummaryRow row) {
  const fs::path folder = results / record.name;
  const std::string suffix = piece.empty() ? "" : " " + piece;
  const Json process = read_result(folder / "process" / piece / "result.json");
  // Files of steps that this batch did not do may be there from an earlier plan.
  Json texture, registration;
  if (was_done(record, "texture" + suffix)) {
    texture = read_result(folder / (flat_name(record.name) + (piece.empty() ? "" : "-" + piece) + ".texture.json"));
  }
  if (was_done(record, "register")) registration = read_result(folder / "register" / "registration.json");
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const Column& column = kColumns[i];
    row.cells[i] = cell_of(column.source == Source::kProcess   ? process
                           : column.source == Source::kTexture ? texture
                                                               : registration,
                           column);
  }
  const bool judged = add_verdicts(process, "", row);
  add_verdicts(registration, "register: ", row);
  const fs::path report = fs::path(record.name) / "process" / piece / "report.html";
  std::error_code ignored;
  if (fs::exists(results / report, ignored)) row.report = report.string();
  for (const StepRecord& step : record.steps) {
    if (step.exit_code != 3) continue;
    // process ends with 3 if one of its segments is invalid: the verdicts say which. Steps of other segments judge
    // those.
    const std::size_t blank = step.name.find(' ');
    const bool of_all = blank == std::string::npos;
    if (!of_all && step.name.substr(blank) != suffix) continue;
    if (step.name == "process" && !piece.empty() && judged) continue;
    lower(row, "invalid", step.name + ": " + step.message);
  }
  return row;
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string out = "\"";
  for (const char c : text) {
    out += c;
    if (c == '"') out += c;
  }
  return out + "\"";
}

// A relative link: each byte that is none of RFC 3986's unreserved ones or '/' in hexadecimal.
std::string link(std::string_view path) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || (byte >= '0' && byte <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    if (plain) {
      out += c;
    } else {
      out += {'%', kHex[byte >> 4U], kHex[byte & 15U]};
    }
  }
  return out;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : " ") + text;
  return out;
}

}  // namespace

std::vector<std::string> summary_columns() {
  std::vector<std::string> out;
  out.reserve(kColumns.size());
  for (const Column& column : kColumns) out.emplace_back(column.name);
  return out;
}

std::vector<SummaryRow> summarise_scan(const ScanRecord& record, const fs::path& results) {
  SummaryRow base;
  base.name = record.name;
  base.recording = record.recording;
  base.status = "valid";
  base.cells.resize(kColumns.size());
  if (record.steps.empty() || !record.steps.back().is_done()) {
    base.status = "failed";
    base.failed_step = record.steps.empty() ? "not begun" : record.steps.back().name;
    if (!record.steps.empty()) base.message = record.steps.back().message;
    return {base};
  }
  std::vector<SummaryRow> out;
  for (const std::string& piece : processed_pieces(results / record.name / "process")) {
    SummaryRow row = base;
    if (!piece.empty()) row.name += "/" + piece;
    try {
      out.push_back(row_of_piece(record, results, piece, row));
    } catch (const Error& error) {
      row.status = "failed";
      row.failed_step = "summary";
      row.message = error.what();
      out.push_back(row);
    }
  }
  if (out.empty()) {
    base.status = "failed";
    base.failed_step = "process";
    base.message = "its results are gone";
    out.push_back(base);
  }
  return out;
}

std::string format_summary_csv(const std::vector<SummaryRow>& rows) {
  std::string out = "name,recording,status,verdicts,failed_step,message";
  for (const Column& column : kColumns) out += "," + std::string(column.name);
  out += "\n";
  for (const SummaryRow& row : rows) {
    out += csv_cell(row.name);
    for (const std::string& cell : {row.recording, row.status, joined(row.codes), row.failed_step, row.message})
      out += "," + csv_cell(cell);
    for (const std::string& cell : row.cells) out += "," + csv_cell(cell);
    out += "\n";
  }
  return out;
}

std::string format_summary_page(const std::vector<SummaryRow>& rows) {
  std::string out =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Asperity: summary of a batch</title>\n"
      "<style>\n"
      "body{font:14px system-ui,sans-serif;margin:24px;color:#1c2430;background:#fff}\n"
      "table{border-collapse:collapse}th,td{padding:3px 10px;border-bottom:1px solid #dde2e8;text-align:right;"
      "font-variant-numeric:tabular-nums;white-space:nowrap}\n"
      "th{position:sticky;top:0;background:#f4f6f8}td:nth-child(-n+3),th:nth-child(-n+3){text-align:left}\n"
      "td.message{text-align:left;white-space:normal;min-width:22em}\n"
      ".valid{color:#1a6b34}.limited{color:#8a5a00}.invalid,.failed{color:#a3201c;font-weight:600}\n"
      "</style></head><body>\n<h1>Summary</h1>\n";
  std::size_t valid = 0, limited = 0, invalid = 0, failed = 0;
  for (const SummaryRow& row : rows)
    ++(row.status == "valid" ? valid : row.status == "limited" ? limited : row.status == "invalid" ? invalid : failed);
  out += "<p>" + std::to_string(rows.size()) + " results: " + std::to_string(valid) + " valid, " +
         std::to_string(limited) + " limited, " + std::to_string(invalid) + " invalid, " + std::to_string(failed) +
         " failed. The same as a table for other programs: <a href=\"summary.csv\">summary.csv</a></p>\n"
         "<table><thead><tr><th>name</th><th>status</th><th>message</th>";
  for (const Column& column : kColumns) out += "<th>" + std::string(column.name) + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const SummaryRow& row : rows) {
    const std::string name = html_text(printable(row.name, 300));
    out += "<tr><td>" + (row.report.empty() ? name : "<a href=\"" + link(row.report) + "\">" + name + "</a>") +
           "</td><td class=\"" + row.status + "\">" + row.status + "</td><td class=\"message\">" +
           html_text((row.failed_step.empty() ? "" : row.failed_step + ": ") + row.message) + "</td>";
    for (const std::string& cell : row.cells) {
      const auto number = parse_double(cell);
      out += "<td>" + (number ? fmt::format("{:.4g}", *number) : html_text(cell)) + "</td>";
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table>\n</body></html>\n";
}

}  // namespace asperity

#include "roughness_files.h"

#include <algorithm>
#include <map>
#include <utility>

#include "asperity/base/html_text.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/plot/format_drawing.h"

namespace asperity::app {

namespace {

using Cells = std::vector<std::pair<std::string, std::string>>;

void add_numbers(const Json& object, Cells& cells) {
  for (const auto& [key, value] : object.items()) {
    if (!value.is_number() && !value.is_null()) continue;
    const bool there = std::any_of(cells.begin(), cells.end(), [&key = key](const auto& c) { return c.first == key; });
    if (!there) cells.emplace_back(key, value.is_null() ? "" : number_text(value.get<double>()));
  }
}

Cells cells_of(const Json& json) {
  Cells out;
  if (json.contains("roughness")) add_numbers(json.at("roughness"), out);
  if (!json.contains("profiles")) return out;
  for (const auto& [letter, profile] : json.at("profiles").items()) {
    Json values = profile;
    for (const char* about : {"length_m", "sections_used", "elements"}) values.erase(about);
    add_numbers(values, out);
  }
  return out;
}

// A cell of text; what would part cells or rows is quoted as RFC 4180 has it.
std::string text_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

// The SVG element alone: an XML declaration has no place within a page.
std::string inline_svg(const Figure& figure) {
  const std::string file = format_drawing(draw_figure(figure), DrawingFormat::kSvg);
  return file.substr(std::min(file.find("<svg "), file.size()));
}

}  // namespace

std::string roughness_csv(const std::vector<RoughnessFound>& found) {
  std::vector<std::string> columns;
  std::vector<std::map<std::string, std::string>> rows;
  for (const RoughnessFound& one : found) {
    std::map<std::string, std::string> row;
    for (auto& [key, value] : cells_of(one.json)) {
      if (std::find(columns.begin(), columns.end(), key) == columns.end()) columns.push_back(key);
      row[key] = std::move(value);
    }
    rows.push_back(std::move(row));
  }
  std::string out = "file,kind";
  for (const std::string& column : columns) out += "," + column;
  out += "\n";
  for (std::size_t i = 0; i < found.size(); ++i) {
    out += text_cell(found[i].file) + "," + found[i].json.at("kind").get<std::string>();
    for (const std::string& column : columns) out += "," + rows[i][column];
    out += "\n";
  }
  return out;
}

std::string roughness_html(const std::vector<RoughnessFound>& found, const std::vector<RoughnessFailure>& failed) {
  std::string out(kRoughnessHtmlBegin);
  out +=
      "\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\n"
      "<title>Roughness</title><style>body{font:15px/1.45 system-ui,sans-serif;max-width:940px;margin:2em auto;"
      "padding:0 1em;color:#222;background:#fff}pre{font:13px/1.4 ui-monospace,monospace;overflow-x:auto}"
      "svg{max-width:100%;height:auto}h2{border-top:1px solid "
      "#ccc;padding-top:1em}.failed{color:#b00020}</style></head>\n"
      "<body><h1>Roughness</h1>\n";
  out += "<p>" + std::to_string(found.size()) + (found.size() == 1 ? " file" : " files") + ", asperity " +
         std::string(kVersion) + ". Values after ± are standard errors.</p>\n";
  for (const RoughnessFailure& failure : failed)
    out +=
        "<p class=\"failed\">" + html_text(printable(failure.file, 200)) + ": " + html_text(failure.message) + "</p>\n";
  for (const RoughnessFound& one : found) {
    out += "<h2>" + html_text(printable(one.file, 200)) + "</h2>\n<pre>" + html_text(one.text) + "</pre>\n";
    if (!one.figure.panels.empty()) out += inline_svg(one.figure) + "\n";
  }
  return out + "</body></html>\n";
}

}  // namespace asperity::app

#include "asperity/studio/format_report.h"
#include "asperity/base/base64.h"

#include <algorithm>
#include <string_view>

#include "asperity/base/base64.h"
#include "asperity/base/error.h"
#include "asperity/base/html_text.h"
#include "asperity/base/text.h"
#include "asperity/web/assets.h"

namespace asperity::studio {

namespace {

// Nothing may be loaded from anywhere.
constexpr std::string_view kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
    "form-action 'none'";

bool begins_with(std::string_view text, std::string_view lower) {
  return text.size() >= lower.size() && std::equal(lower.begin(), lower.end(), text.begin(), [](char expected, char c) {
           return expected == (c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
         });
}

// What ends a script or style element, or hides its end. Such text is in strings and regular expressions alone,
// where the backslash changes nothing.
std::string inline_text(std::string_view text) {
  std::string out;
  out.reserve(text.size() + 64);
  for (std::size_t i = 0; i < text.size(); ++i) {
    out += text[i];
    const std::string_view rest = text.substr(i);
    if (begins_with(rest, "</script") || begins_with(rest, "</style") || begins_with(rest, "<!--")) out += '\\';
  }
  return out;
}

std::string shown_name(const ReportItem& item) { return is_utf8(item.name) ? item.name : printable(item.name, 200); }

std::string title_of(const std::vector<ReportItem>& items) {
  const std::string first = shown_name(items[0]);
  return items.size() == 1 ? first : first + " and " + std::to_string(items.size() - 1) + " more";
}

}  // namespace

std::string format_report(const std::vector<ReportItem>& items) {
  if (items.empty()) throw Error("a report needs at least one result");
  if (!web::built()) {
    throw Error("this asperity was built without reports. " + std::string(web::why_not_built()) + ", and build again");
  }
  std::string out = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out += "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n";
  out += "<meta name=\"generator\" content=\"Asperity\">\n";
  out += "<meta http-equiv=\"Content-Security-Policy\" content=\"" + std::string(kPolicy) + "\">\n";
  out += "<title>" + html_text(title_of(items)) + " – Asperity</title>\n";
  out += "<style>" + inline_text(web::report_style()) + "</style>\n</head>\n<body>\n";
  out += "<div id=\"report\"><noscript>This report draws its plots with JavaScript, which is off.</noscript></div>\n";
  for (const ReportItem& item : items) {
    out += "<script type=\"application/octet-stream\" data-name=\"" + html_text(shown_name(item)) + "\">" +
           base64(item.block) + "</script>\n";
  }
  out += "<script>" + inline_text(web::report_script()) + "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace asperity::studio

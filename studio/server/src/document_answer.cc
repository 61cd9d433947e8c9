#include "document_answer.h"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestDocument_bytes = 32U << 20U;
constexpr std::array<std::pair<std::string_view, const char*>, 8> kTypes{{{".html", "text/html; charset=utf-8"},
                                                                          {".css", "text/css; charset=utf-8"},
                                                                          {".js", "text/javascript; charset=utf-8"},
                                                                          {".json", "application/json"},
                                                                          {".svg", "image/svg+xml"},
                                                                          {".png", "image/png"},
                                                                          {".csv", "text/csv; charset=utf-8"},
                                                                          {".stl", "model/stl"}}};

constexpr const char* kMissing =
    "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Documents of Asperity</title></head>\n"
    "<body><h1>The documents are not installed with this program</h1>\n"
    "<p>Install the package <code>asperity</code>, which has them, or build them in the source folder with "
    "<code>scripts/site</code>. Then load this page again.</p>\n"
    "<p>In a terminal, <code>asperity help COMMAND</code> explains a command, and <code>asperity --man | man -l "
    "-</code> "
    "shows all of them.</p></body></html>\n";

HttpAnswer with_policy(unsigned status, const char* type, std::string body) {
  HttpAnswer answer;
  answer.status = status;
  answer.headers = safety_headers(std::nullopt);
  for (auto& [name, value] : answer.headers) {
    if (name != "Content-Security-Policy") continue;
    value =
        "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; img-src 'self' "
        "data:; "
        "worker-src 'self' blob:; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
        "connect-src 'none'";
  }
  answer.headers.emplace_back("Content-Type", type);
  answer.body = std::move(body);
  return answer;
}

// Names of a built site: nothing that leads out of its folder.
bool is_plain(std::string_view path) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.' || c == '/';
  };
  return path.starts_with('/') && std::all_of(path.begin(), path.end(), plain) &&
         path.find("/.") == std::string_view::npos && path.find("//") == std::string_view::npos;
}

}  // namespace

HttpAnswer answer_document(std::string_view path, const fs::path& documents) {
  path.remove_prefix(std::string_view("/docs").size());
  if (path.empty()) path = "/";
  const std::string name = std::string(path) + (path.ends_with('/') ? "index.html" : "");
  if (!is_plain(name)) return refusal(404, "nothing exists at this address");
  std::error_code error;
  if (documents.empty() || !fs::is_regular_file(documents / "index.html", error)) {
    return with_policy(404, "text/html; charset=utf-8", kMissing);
  }
  const fs::path file = documents / name.substr(1);
  const auto type =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& one) { return name.ends_with(one.first); });
  if (type == kTypes.end() || !fs::is_regular_file(file, error)) return refusal(404, "nothing exists at this address");
  try {
    return with_policy(200, type->second, read_file(file, kLargestDocument_bytes));
  } catch (const Error&) {
    return refusal(404, "this document cannot be read");
  }
}

}  // namespace asperity::studio

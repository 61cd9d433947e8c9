#include "http_answer.h"

#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/studio/block.h"
#include "document_answer.h"
#include "secret.h"

namespace asperity::studio {

namespace {

std::optional<std::string> session_cookie(const HttpRequest& request, const Site& site) {
  if (!request.cookie) return std::nullopt;
  const auto value = cookie_value(*request.cookie, site.cookie_name);
  return value ? std::optional<std::string>(*value) : std::nullopt;
}

bool takes_gzip(const HttpRequest& request) {
  if (!request.accept_encoding) return true;  // a request that names none accepts any (RFC 9110, 12.5.3)
  std::string_view rest = *request.accept_encoding;
  while (!rest.empty()) {
    const std::size_t end = rest.find(',');
    const std::string_view one = trim(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (one == "gzip") return true;
    if (one.starts_with("gzip;")) return !one.ends_with("=0") && one.find("=0.000") == std::string_view::npos;
  }
  return false;
}

HttpAnswer wrong_method(std::string_view allowed) {
  HttpAnswer answer = refusal(405, "this method is not allowed here");
  answer.headers.emplace_back("Allow", allowed);
  return answer;
}

HttpAnswer answer_asset(const HttpRequest& request, std::string_view path, const Site& site) {
  const auto asset = site.asset(path == "/" ? "/index.html" : path);
  if (!asset) return refusal(404, "nothing exists at this address");
  const bool unpacked = asset->compressed && !takes_gzip(request);
  HttpAnswer answer;
  answer.headers = safety_headers(site.hosts.socket_origin(*request.host));
  answer.headers.emplace_back("Content-Type", asset->content_type);
  if (asset->compressed && !unpacked) answer.headers.emplace_back("Content-Encoding", "gzip");
  answer.body = unpacked ? site.unpack(asset->content) : std::string(asset->content);
  return answer;
}

std::optional<std::string> token_of(const std::string& body) {
  const Json json = parse_json_or_null(body);
  if (!json.is_object() || json.size() != 1 || !json.contains("token") || !json["token"].is_string()) {
    return std::nullopt;
  }
  return json["token"].get<std::string>();
}

HttpAnswer answer_session(const HttpRequest& request, const Site& site) {
  if (!request.origin || !site.hosts.is_own_origin(*request.origin, *request.host)) {
    return refusal(403, "this page has another origin");
  }
  const auto token = token_of(request.body);
  if (!token) return refusal(400, "this is not {\"token\":…}");
  const auto [kind, cookie] =
      site.sessions->admit(*token, {request.from, request.agent, session_cookie(request, site)});
  if (kind == Sessions::Answer::kWrongToken) {
    HttpAnswer answer = refusal(403, "this token is not this server's; open the address that it printed");
    answer.late = true;
    return answer;
  }
  if (kind == Sessions::Answer::kFull) return refusal(503, "too many sessions have a window open; close one");
  HttpAnswer answer;
  answer.status = 204;
  answer.headers = safety_headers(site.hosts.socket_origin(*request.host));
  answer.headers.emplace_back("Set-Cookie", site.cookie_name + "=" + cookie + "; HttpOnly; SameSite=Strict; Path=/" +
                                                (site.hosts.is_encrypted() ? "; Secure" : ""));
  return answer;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> safety_headers(const std::optional<std::string>& socket_origin) {
  std::string policy =
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; worker-src 'self'; "
      "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; connect-src 'self'";
  // Not all browsers take a WebSocket of the same origin for 'self'.
  if (socket_origin) policy += " " + *socket_origin;
  return {
      {"Content-Security-Policy", policy},
      {"Referrer-Policy", "no-referrer"},
      {"X-Content-Type-Options", "nosniff"},
      {"X-Frame-Options", "DENY"},
      {"Cross-Origin-Opener-Policy", "same-origin"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Cache-Control", "no-store"},
      {"Permissions-Policy", "camera=(), microphone=(), geolocation=(), usb=(), serial=()"},
  };
}

HttpAnswer refusal(unsigned status, std::string_view words) {
  HttpAnswer answer;
  answer.status = status;
  answer.headers = safety_headers(std::nullopt);
  answer.headers.emplace_back("Content-Type", "text/plain; charset=utf-8");
  answer.body = std::string(words) + "\n";
  return answer;
}

HttpAnswer answer_http(const HttpRequest& request, const Site& site) {
  if (!request.host || !site.hosts.contains(*request.host)) {
    return refusal(403, "this server does not have that name; open the address that it printed");
  }
  const std::string_view path = std::string_view(request.target).substr(0, request.target.find('?'));
  if (path == "/session") {
    return request.method == "POST" ? answer_session(request, site) : wrong_method("POST");
  }
  if (request.method != "GET") return wrong_method("GET");
  if (path == "/ws") {
    HttpAnswer answer = refusal(426, "this is a WebSocket");
    answer.headers.emplace_back("Upgrade", "websocket");
    return answer;
  }
  if (path == "/docs" || path.starts_with("/docs/")) return answer_document(path, site.documents);
  return answer_asset(request, path, site);
}

Admitted admit_websocket(const HttpRequest& request, const Site& site) {
  const bool own = request.host && request.origin && site.hosts.is_own_origin(*request.origin, *request.host);
  if (!own || request.method != "GET" || request.target != "/ws") return {};
  const auto cookie = session_cookie(request, site);
  const auto session = cookie ? site.sessions->find(*cookie) : std::nullopt;
  if (!session) return {Admission::kStranger, 0};
  return {Admission::kWelcome, *session};
}

}  // namespace asperity::studio

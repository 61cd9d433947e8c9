#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "asperity/web/assets.h"
#include "own_hosts.h"
#include "sessions.h"

namespace asperity::studio {

// What of a request matters. A header that is there twice is as absent.
struct HttpRequest {
  std::string method, target, body;
  std::optional<std::string> host, origin, cookie, accept_encoding;
  std::string from, agent;  // the address that it comes from, and what the browser calls itself
};

struct HttpAnswer {
  unsigned status = 200;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  bool late = false;  // to be held back for a while: a guess should cost time
};

// What a server is and what it serves.
struct Site {
  OwnHosts hosts;
  Sessions* sessions = nullptr;  // not null
  std::string cookie_name;
  std::function<std::optional<web::Asset>(std::string_view path)> asset;
  std::function<std::string(std::string_view gzip)> unpack;  // for a browser without gzip
  std::filesystem::path documents = {};                      // of WebServerConfig
};

// The answer to a request that asks for no WebSocket (docs/studio-safety.md).
HttpAnswer answer_http(const HttpRequest& request, const Site& site);

// A refusal with the headers that all answers have.
HttpAnswer refusal(unsigned status, std::string_view words);

// The headers of every answer, a refused one's too; `socket_origin` is where the page may open its WebSocket,
// "ws://127.0.0.1:8137", if the request's Host is one of the site's own.
std::vector<std::pair<std::string, std::string>> safety_headers(const std::optional<std::string>& socket_origin);

enum class Admission {
  kForeign,   // of another host or origin, or for another path: no WebSocket
  kStranger,  // our own page, without the cookie: which close code 4401 states
  kWelcome,
};
struct Admitted {
  Admission admission = Admission::kForeign;
  std::uint64_t session = 0;  // of one that is welcome
};
Admitted admit_websocket(const HttpRequest& request, const Site& site);

}  // namespace asperity::studio

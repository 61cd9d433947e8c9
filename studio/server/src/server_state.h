#pragma once

// Included by web_server.cc alone, which has included Beast.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "asperity/studio/web_server.h"
#include "client_table.h"
#include "http_answer.h"
#include "server_limits.h"
#include "sessions.h"

namespace asperity::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;
using tcp = asio::ip::tcp;
using PlainStream = beast::tcp_stream;
using TlsStream = beast::ssl_stream<beast::tcp_stream>;

// What all connections of a server share; lives longer than they.
struct ServerState {
  ServerState(const WebServerConfig& new_config, const WebServerEvents& new_events, Site new_site)
      : config(new_config),
        events(new_events),
        site(std::move(new_site)),
        clients(static_cast<std::size_t>(std::max(0, new_config.max_clients))) {
    site.sessions = &sessions;
  }

  const WebServerConfig config;
  const WebServerEvents events;
  Site site;
  Sessions sessions{kMostSessions};
  ClientTable clients;
  std::chrono::steady_clock::time_point next_handshake;  // the server's thread alone
  int connections = 0;                                   // open ones, of either kind; the server's thread alone
  bool is_over = false;                                  // after its thread's end: no event any more
};

inline std::chrono::nanoseconds seconds(double s) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9));
}

inline void set_headers(http::fields& fields, const std::vector<std::pair<std::string, std::string>>& headers) {
  for (const auto& [name, value] : headers) fields.set(name, value);
}

// One of the counted open connections.
class Counted {
 public:
  explicit Counted(ServerState& server) : server_(&server) { ++server_->connections; }
  ~Counted() { --server_->connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  ServerState* server_;
};

}  // namespace asperity::studio

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "asperity/studio/hub.h"
#include "asperity/studio/message.h"
#include "asperity/studio/session_info.h"

namespace asperity::studio {

struct WebServerConfig {
  std::string host = "127.0.0.1";
  int port = 0;  // 0: a free one
  int max_clients = 64;
  double request_timeout_s = 10.0;  // for a whole request, a handshake and its answer
  double idle_timeout_s = 30.0;     // without a sign of life from a browser, which is asked for one
  // The documents as a site (scripts/site), shown at /docs/; empty or not there: a page states how to get them.
  std::filesystem::path documents;
  // PEM files: with them the server speaks https alone, without them http. Both or none.
  std::filesystem::path tls_certificate, tls_key;
};

// True if only programs on this machine can reach `host`.
bool is_this_machine_only(const std::string& host);

// What the server states. Called on its own thread: pass it on.
struct WebServerEvents {
  std::function<void(ClientId)> joined;
  std::function<void(ClientId)> left;
  std::function<void(ClientId, Message)> message;
};

// Serves the embedded app over HTTP and its messages over a WebSocket, from one thread of its own
// (docs/studio-safety.md). Without a cookie that was given for the token, nothing but the bare app is served. Host is
// checked on every request, Origin on every WebSocket; an absent one is foreign. Token and cookies are 128 bits from
// the system each, new with every start.
class WebServer : public Hub {
 public:
  // Listens at once. Throws Error if the address cannot be had, saying who might have it, or if certificate or key
  // cannot be used.
  static std::unique_ptr<WebServer> start(const WebServerConfig& config, WebServerEvents events);

  virtual int port() const = 0;
  virtual std::string address() const = 0;  // "http://127.0.0.1:8137/#token=…"
  // What is wrong with the certificate that browsers will complain of.
  virtual std::vector<std::string> warnings() const = 0;
  // A new token: the old address and all sessions end, their WebSockets are closed with 4401.
  virtual void renew_token() = 0;
  virtual std::vector<SessionInfo> sessions() const = 0;
  // The session of a window; 0 if it has gone.
  virtual std::uint64_t session_of(ClientId client) const = 0;
  // Ends one session; false if there is none of that number.
  virtual bool close_session(std::uint64_t number) = 0;
  // Frames of series that were dropped for slow browsers, over all time.
  virtual std::uint64_t dropped_frames() const = 0;
  // Closes all connections and waits for its thread; no event comes after. The destructor does too.
  virtual void stop() = 0;
};

}  // namespace asperity::studio

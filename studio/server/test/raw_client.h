#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

struct ssl_st;

namespace asperity::studio {

// A browser's end of a connection over plain sockets, which sends any bytes. Waits at most ten seconds for
// anything; throws std::runtime_error then.
class RawClient {
 public:
  explicit RawClient(int port, int receive_buffer_bytes = 0);
  // Speaks TLS from here on, taking any certificate; `version` TLS1_2_VERSION or another, 0: what both can. False if
  // the handshake fails.
  bool start_tls(int version = 0);
  ~RawClient();
  RawClient(RawClient&& other) noexcept;
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;
  RawClient& operator=(RawClient&&) = delete;

  // False if the other side has closed.
  bool send(std::string_view bytes);

  struct Response {
    int status = 0;
    std::string head, body;
    // A header's value; empty if it is not there.
    std::string header(std::string_view name) const;
  };
  // One HTTP response.
  Response response();
  // True once the other side has closed; what it sends before is thrown away.
  bool closes();

  // RFC 6455 frames. `opcode` 1 text, 2 binary, 8 close, 9 ping.
  static std::string frame(unsigned opcode, std::string_view payload, bool final = true, bool masked = true);
  struct Frame {
    unsigned opcode = 0;
    std::string payload;
    // Of a close frame.
    int close_code() const;
  };
  // The next frame that is not a ping, which is answered; nullopt if the other side has closed.
  std::optional<Frame> next_frame();

 private:
  bool fill();  // false at the end
  bool need(std::size_t bytes);

  int socket_ = -1;
  ssl_st* tls_ = nullptr;
  std::string received_;
};

// The request for a WebSocket at `port`; `headers` are lines with their ends.
std::string upgrade_request(int port, std::string_view headers);

// A browser as it should be: it has changed the token of `address`, of http or https, for a cookie.
std::string session_cookie(int port, const std::string& address);
// And has opened its WebSocket.
RawClient open_websocket(int port, const std::string& cookie, int receive_buffer_bytes = 0, bool is_tls = false);

}  // namespace asperity::studio

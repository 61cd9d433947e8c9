#pragma once

// Included by web_server.cc alone, which has included Beast.

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>

#include "http_connection.h"
#include "server_limits.h"
#include "server_state.h"

namespace asperity::studio {

// A connection to a server with a certificate until its handshake is done: within the time of one request, all of it,
// the wait for its turn too.
class TlsDoor : public std::enable_shared_from_this<TlsDoor> {
 public:
  TlsDoor(tcp::socket socket, ServerState& server, asio::ssl::context& context)
      : plain_(std::move(socket)), turn_(plain_.get_executor()), server_(server), context_(context) {}

  void open() {
    plain_.expires_after(seconds(server_.config.request_timeout_s));
    beast::async_detect_ssl(plain_, buffer_, [self = shared_from_this()](const error_code& error, bool is_tls) {
      if (error) return;
      if (is_tls) return self->wait_for_turn();
      std::make_shared<HttpConnection<PlainStream>>(std::move(self->plain_), self->server_)
          ->turn_away(refusal(400, "this server speaks https; open the address that it printed"));
    });
  }

 private:
  void wait_for_turn() {
    const auto now = std::chrono::steady_clock::now();
    server_.next_handshake = std::max(server_.next_handshake, now - kMostHandshakesAhead * kHandshakesApart);
    turn_.expires_at(server_.next_handshake);
    if (turn_.expiry() - now > seconds(server_.config.request_timeout_s)) return;
    server_.next_handshake += kHandshakesApart;
    if (turn_.expiry() <= now) return shake_hands();
    turn_.async_wait([self = shared_from_this()](const error_code& stopped) {
      if (!stopped) self->shake_hands();
    });
  }

  void shake_hands() {
    tls_.emplace(std::move(plain_), context_);
    tls_->async_handshake(asio::ssl::stream_base::server, buffer_.data(),
                          [self = shared_from_this()](const error_code& error, std::size_t used) {
                            if (error || used != self->buffer_.size()) return;
                            std::make_shared<HttpConnection<TlsStream>>(std::move(*self->tls_), self->server_)->read();
                          });
  }

  beast::tcp_stream plain_;
  std::optional<TlsStream> tls_;
  asio::steady_timer turn_;
  ServerState& server_;
  asio::ssl::context& context_;
  const Counted counted_{server_};
  beast::flat_buffer buffer_{kMostHeaderBytes};
};

}  // namespace asperity::studio

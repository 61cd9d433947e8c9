#pragma once

// Included by web_server.cc alone, which has included Beast.

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "server_limits.h"
#include "server_state.h"
#include "socket_connection.h"

namespace asperity::studio {

// One connection that speaks HTTP, until it becomes a WebSocket.
template <class Stream>
class HttpConnection : public std::enable_shared_from_this<HttpConnection<Stream>> {
 public:
  HttpConnection(Stream stream, ServerState& server)
      : stream_(std::move(stream)), delay_(stream_.get_executor()), server_(server) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(kMostBodyBytes);
    lowest().expires_after(seconds(server_.config.request_timeout_s));
    http::async_read(
        stream_, buffer_, *parser_,
        [self = this->shared_from_this()](const error_code& error, std::size_t) { self->take_request(error); });
  }

  // Without a request: answers, and closes.
  void turn_away(HttpAnswer answer) { write(std::move(answer), false); }

 private:
  beast::tcp_stream& lowest() { return beast::get_lowest_layer(stream_); }

  void take_request(const error_code& error) {
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      return write(refusal(431, "this request's header is too long"), false);
    }
    if (error == http::error::body_limit) return write(refusal(413, "this request is too long"), false);
    if (error.category() == make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream) {
      return write(refusal(400, "this is not a request"), false);
    }
    if (error) return;
    const auto& message = parser_->get();
    const HttpRequest request = plain(message);
    if (websocket::is_upgrade(message)) {
      const Admitted admitted = admit_websocket(request, server_.site);
      if (admitted.admission == Admission::kForeign) return write(refusal(403, "this is not for this page"), false);
      lowest().expires_never();
      return std::make_shared<SocketConnection<Stream>>(std::move(stream_), server_)->accept(message, admitted);
    }
    HttpAnswer answer = answer_http(request, server_.site);
    if (!answer.late) return write(std::move(answer), message.keep_alive());
    delay_.expires_after(kGuessDelay);
    delay_.async_wait([self = this->shared_from_this(), answer = std::move(answer)](const error_code& stopped) mutable {
      if (!stopped) self->write(std::move(answer), false);
    });
  }

  HttpRequest plain(const http::request<http::string_body>& message) {
    const auto once = [&message](http::field field) -> std::optional<std::string> {
      if (message.count(field) != 1) return std::nullopt;
      return std::string(message[field]);
    };
    error_code gone;
    const tcp::endpoint from = lowest().socket().remote_endpoint(gone);
    return {std::string(message.method_string()),
            std::string(message.target()),
            message.body(),
            once(http::field::host),
            once(http::field::origin),
            once(http::field::cookie),
            once(http::field::accept_encoding),
            gone ? std::string() : from.address().to_string(),
            once(http::field::user_agent).value_or("")};
  }

  void write(HttpAnswer answer, bool keep_alive) {
    response_.emplace(static_cast<http::status>(answer.status), 11);
    set_headers(*response_, answer.headers);
    response_->body() = std::move(answer.body);
    response_->keep_alive(keep_alive);
    response_->prepare_payload();
    lowest().expires_after(seconds(server_.config.request_timeout_s));
    http::async_write(stream_, *response_,
                      [self = this->shared_from_this(), keep_alive](const error_code& error, std::size_t) {
                        if (error) return;
                        if (keep_alive) return self->read();
                        self->finish();
                      });
  }

  // Ends the sending, and reads what the other side had still sent: closing a socket with unread bytes
  // would take the answer back from it.
  void finish() {
    if constexpr (std::is_same_v<Stream, TlsStream>) {
      stream_.async_shutdown([self = this->shared_from_this()](const error_code&) { self->end_sending(); });
    } else {
      end_sending();
    }
  }

  void end_sending() {
    error_code ignored;
    lowest().socket().shutdown(tcp::socket::shutdown_send, ignored);
    drain(0);
  }

  void drain(std::size_t drained) {
    if (drained > kMostDrainedBytes) return;
    buffer_.consume(buffer_.size());
    lowest().async_read_some(buffer_.prepare(kMostBodyBytes),
                             [self = this->shared_from_this(), drained](const error_code& error, std::size_t bytes) {
                               if (!error) self->drain(drained + bytes);
                             });
  }

  Stream stream_;
  asio::steady_timer delay_;
  ServerState& server_;
  const Counted counted_{server_};
  beast::flat_buffer buffer_{kMostHeaderBytes + kMostBodyBytes};
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> response_;
};

}  // namespace asperity::studio

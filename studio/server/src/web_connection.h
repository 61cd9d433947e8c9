#pragma once

// Included by web_server.cc alone, which has included Beast.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "answer_text.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/studio/web_server.h"
#include "client_table.h"
#include "http_answer.h"

namespace asperity::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using boost::system::error_code;
using tcp = asio::ip::tcp;

// What all connections of a server share; lives longer than they.
struct ServerState {
  ServerState(const WebServerConfig& new_config, const WebServerEvents& new_events, Site new_site)
      : config(new_config),
        events(new_events),
        site(std::move(new_site)),
        clients(static_cast<std::size_t>(std::max(0, new_config.max_clients))) {}

  const WebServerConfig config;
  const WebServerEvents events;
  const Site site;
  ClientTable clients;
  int connections = 0;   // open ones, of either kind; the server's thread alone
  bool is_over = false;  // after its thread's end: no event any more
};

inline std::chrono::nanoseconds seconds(double s) {
  return std::chrono::nanoseconds(static_cast<std::int64_t>(s * 1e9));
}

inline void set_headers(http::fields& fields, const std::vector<std::pair<std::string, std::string>>& headers) {
  for (const auto& [name, value] : headers) fields.set(name, value);
}

// A place among the open connections.
class Counted {
 public:
  explicit Counted(ServerState& server) : server_(&server) { ++server_->connections; }
  ~Counted() { --server_->connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  ServerState* server_;
};

// One browser's WebSocket. All functions are for the server's thread.
class SocketConnection : public std::enable_shared_from_this<SocketConnection> {
 public:
  SocketConnection(beast::tcp_stream stream, ServerState& server)
      : stream_(std::move(stream)), pause_(stream_.get_executor()), server_(server) {}
  // Whatever ended it, an exception in a handler too, its place is free again.
  ~SocketConnection() {
    try {
      if (!server_.is_over) leave();
    } catch (const std::exception&) {
      // Without memory for the event: the place is free all the same.
    }
  }
  SocketConnection(const SocketConnection&) = delete;
  SocketConnection& operator=(const SocketConnection&) = delete;

  void accept(const http::request<http::string_body>& request, Admission admission) {
    stream_.set_option(websocket::stream_base::timeout{seconds(server_.config.request_timeout_s),
                                                       seconds(server_.config.idle_timeout_s), true});
    stream_.set_option(websocket::stream_base::decorator(
        [](websocket::response_type& response) { set_headers(response, safety_headers(std::nullopt)); }));
    stream_.read_message_max(kMaxMessageBytes);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = shared_from_this(), admission](const error_code& error) {
      if (!error) self->join(admission);
    });
  }

 private:
  void join(Admission admission) {
    if (admission == Admission::kStranger) return end({websocket::close_code(4401), "no session"});
    // Only this thread may hold a connection, for the last one to hold it closes it: others hand on a weak pointer.
    const auto client = server_.clients.join([weak = weak_from_this(), executor = stream_.get_executor()] {
      asio::post(executor, [weak] {
        if (const auto self = weak.lock()) self->pump();
      });
    });
    if (!client) return end({websocket::close_code::try_again_later, "too many browsers"});
    client_ = *client;
    if (server_.events.joined) server_.events.joined(client_);
    read();
  }

  void read() {
    if (server_.clients.is_full(client_)) return wait_for_answers();
    stream_.async_read(buffer_, [self = shared_from_this()](const error_code& error, std::size_t) {
      if (error) return self->leave();
      self->take_message();
    });
  }

  // What was sent waits in the system's buffers until calls are answered, which pump() hears of; not for ever, for a
  // browser that has gone would not be noticed.
  void wait_for_answers() {
    waiting_ = true;
    pause_.expires_after(seconds(server_.config.idle_timeout_s));
    pause_.async_wait([self = shared_from_this()](const error_code&) {
      self->waiting_ = false;
      if (self->leaving_) return;
      if (!self->server_.clients.is_full(self->client_)) return self->read();
      beast::get_lowest_layer(self->stream_).close();
      self->leave();
    });
  }

  void take_message() {
    if (leaving_) return;
    try {
      const auto bytes = buffer_.cdata();
      Message message = decode_message({static_cast<const char*>(bytes.data()), bytes.size()}, stream_.got_text());
      const std::size_t size = bytes.size();
      buffer_.consume(size);
      dispatch(std::move(message), size);
    } catch (const Error& error) {
      // A close frame holds 123 bytes of reason.
      return end({websocket::close_code::policy_error, printable(error.what(), 30)});
    }
    read();
  }

  void dispatch(Message message, std::size_t bytes) {
    if (const Call* call = std::get_if<Call>(&message)) {
      if (call->name == "subscribe" || call->name == "unsubscribe") return answer_subscription(*call);
      if (!server_.clients.begin_call(client_, call->id, bytes)) {
        return refuse(*call, "more than 1000 calls wait for their answers");
      }
    }
    if (std::holds_alternative<Pointer>(message) && !pointer_has_time()) return;
    if (server_.events.message) server_.events.message(client_, std::move(message));
  }

  // A thousand a second, in heaps of at most a hundred: a flood of them must not pile up behind the server.
  bool pointer_has_time() {
    constexpr auto kApart = std::chrono::milliseconds(1);
    constexpr auto kMostAhead = 100 * kApart;
    const auto now = std::chrono::steady_clock::now();
    pointer_time_ = std::max(pointer_time_, now - kMostAhead);
    if (pointer_time_ > now) return false;
    pointer_time_ += kApart;
    return true;
  }

  void answer_subscription(const Call& call) {
    try {
      const Json* topic = call.args.find("topic");
      if (topic == nullptr || !topic->is_string() || call.args.size() != 1) {
        throw Error(call.name + ": needs a topic and nothing else");
      }
      const auto& name = topic->text();
      if (call.name == "subscribe") {
        server_.clients.subscribe(client_, name);
      } else {
        server_.clients.unsubscribe(client_, name);
      }
      server_.clients.send(client_, answer_text(call.id, Json::object()), true);
    } catch (const Error& error) {
      refuse(call, error.what());
    }
  }

  void refuse(const Call& call, std::string_view words) {
    server_.clients.send(client_, refusal_text(call.id, words, "Reload the page."), true);
  }

  // Sends what waits, one frame after another.
  void pump() {
    if (leaving_) return;
    if (server_.clients.is_cut(client_)) {
      beast::get_lowest_layer(stream_).close();
      return leave();
    }
    if (waiting_ && !server_.clients.is_full(client_)) pause_.cancel();
    if (writing_ || server_.clients.next(client_, frame_) != ClientTable::State::kFrame) return;
    writing_ = true;
    stream_.text(frame_.is_text);
    stream_.async_write(asio::buffer(*frame_.bytes), [self = shared_from_this()](const error_code& error, std::size_t) {
      self->writing_ = false;
      self->frame_.bytes.reset();
      if (self->closing_) return self->close();
      if (error) return self->leave();
      self->pump();
    });
  }

  // Closes with a reason, behind the frame that is being sent. Nothing of this client is heard from now on.
  void end(const websocket::close_reason& reason) {
    leave();
    closing_ = true;
    reason_ = reason;
    if (!writing_) close();
  }

  void close() {
    stream_.async_close(reason_, [self = shared_from_this()](const error_code&) {});
  }

  void leave() {
    leaving_ = true;
    pause_.cancel();
    if (client_ != 0 && server_.clients.leave(client_) && server_.events.left) server_.events.left(client_);
  }

  websocket::stream<beast::tcp_stream> stream_;
  asio::steady_timer pause_;
  ServerState& server_;
  const Counted counted_{server_};
  beast::flat_buffer buffer_;
  ClientId client_ = 0;
  std::chrono::steady_clock::time_point pointer_time_;
  OutFrame frame_;
  websocket::close_reason reason_;
  bool waiting_ = false, writing_ = false, closing_ = false, leaving_ = false;
};

// One connection that speaks HTTP, until it becomes a WebSocket.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket socket, ServerState& server)
      : stream_(std::move(socket)), delay_(stream_.get_executor()), server_(server) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(kMostBodyBytes);
    stream_.expires_after(seconds(server_.config.request_timeout_s));
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](const error_code& error, std::size_t) { self->take_request(error); });
  }

 private:
  static constexpr std::uint32_t kMostHeaderBytes = 8U << 10U;
  static constexpr std::uint64_t kMostBodyBytes = 4U << 10U;
  static constexpr auto kGuessDelay = std::chrono::milliseconds(250);

  void take_request(const error_code& error) {
    if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      return write(refusal(431, "this request's header is too long"), false);
    }
    if (error == http::error::body_limit) return write(refusal(413, "this request is too long"), false);
    if (error.category() == make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream) {
      return write(refusal(400, "this is no request"), false);
    }
    if (error) return;
    const auto& message = parser_->get();
    const HttpRequest request = plain(message);
    if (websocket::is_upgrade(message)) {
      const Admission admission = admit_websocket(request, server_.site);
      if (admission == Admission::kForeign) return write(refusal(403, "this is not for this page"), false);
      stream_.expires_never();
      return std::make_shared<SocketConnection>(std::move(stream_), server_)->accept(message, admission);
    }
    HttpAnswer answer = answer_http(request, server_.site);
    if (!answer.late) return write(std::move(answer), message.keep_alive());
    delay_.expires_after(kGuessDelay);
    delay_.async_wait([self = shared_from_this(), answer = std::move(answer)](const error_code& stopped) mutable {
      if (!stopped) self->write(std::move(answer), false);
    });
  }

  static HttpRequest plain(const http::request<http::string_body>& message) {
    const auto once = [&message](http::field field) -> std::optional<std::string> {
      if (message.count(field) != 1) return std::nullopt;
      return std::string(message[field]);
    };
    return {std::string(message.method_string()),
            std::string(message.target()),
            message.body(),
            once(http::field::host),
            once(http::field::origin),
            once(http::field::cookie),
            once(http::field::accept_encoding)};
  }

  void write(HttpAnswer answer, bool keep_alive) {
    response_.emplace(static_cast<http::status>(answer.status), 11);
    set_headers(*response_, answer.headers);
    response_->body() = std::move(answer.body);
    response_->keep_alive(keep_alive);
    response_->prepare_payload();
    stream_.expires_after(seconds(server_.config.request_timeout_s));
    http::async_write(stream_, *response_,
                      [self = shared_from_this(), keep_alive](const error_code& error, std::size_t) {
                        if (error) return;
                        if (keep_alive) return self->read();
                        error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                        self->drain(0);
                      });
  }

  // Closing a socket with unread bytes would take the answer back from the other side.
  void drain(std::size_t drained) {
    constexpr std::size_t kMost = 1U << 20U;
    if (drained > kMost) return;
    buffer_.consume(buffer_.size());
    stream_.async_read_some(buffer_.prepare(kMostBodyBytes),
                            [self = shared_from_this(), drained](const error_code& error, std::size_t bytes) {
                              if (!error) self->drain(drained + bytes);
                            });
  }

  beast::tcp_stream stream_;
  asio::steady_timer delay_;
  ServerState& server_;
  const Counted counted_{server_};
  beast::flat_buffer buffer_{kMostHeaderBytes + kMostBodyBytes};
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<http::response<http::string_body>> response_;
};

}  // namespace asperity::studio

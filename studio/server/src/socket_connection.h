#pragma once

// Included by web_server.cc alone, which has included Beast.

#include <algorithm>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "answer_text.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "server_limits.h"
#include "server_state.h"

namespace asperity::studio {

// One browser's WebSocket. All functions are for the server's thread.
template <class Stream>
class SocketConnection : public std::enable_shared_from_this<SocketConnection<Stream>> {
 public:
  SocketConnection(Stream stream, ServerState& server)
      : stream_(std::move(stream)), pause_(stream_.get_executor()), server_(server) {}
  // However it ended, also by an exception in a handler, it does not count any more.
  ~SocketConnection() {
    try {
      if (!server_.is_over) leave();
    } catch (const std::exception&) {
      // Without memory for the event it does not count either.
    }
  }
  SocketConnection(const SocketConnection&) = delete;
  SocketConnection& operator=(const SocketConnection&) = delete;

  void accept(const http::request<http::string_body>& request, const Admitted& admitted) {
    stream_.set_option(websocket::stream_base::timeout{seconds(server_.config.request_timeout_s),
                                                       seconds(server_.config.idle_timeout_s), true});
    stream_.set_option(websocket::stream_base::decorator(
        [](websocket::response_type& response) { set_headers(response, safety_headers(std::nullopt)); }));
    stream_.read_message_max(kMaxMessageBytes);
    stream_.auto_fragment(false);
    stream_.async_accept(request, [self = this->shared_from_this(), admitted](const error_code& error) {
      if (!error) self->join(admitted);
    });
  }

 private:
  void join(const Admitted& admitted) {
    if (admitted.admission == Admission::kStranger) return end(no_session());
    const auto client = server_.clients.join(from_any_thread(&SocketConnection::pump));
    if (!client) return end({websocket::close_code::try_again_later, "too many browsers"});
    client_ = *client;
    // The session may have been closed while the WebSocket was being opened.
    if (!server_.sessions.add_window(admitted.session, client_, from_any_thread(&SocketConnection::end_session))) {
      return end_session();
    }
    if (server_.events.joined) server_.events.joined(client_);
    read();
  }

  static websocket::close_reason no_session() { return {websocket::close_code(4401), "no session"}; }

  void end_session() {
    if (!leaving_) end(no_session());
  }

  // Only this thread may hold a connection, for the last one to hold it closes it: others hand on a weak pointer.
  std::function<void()> from_any_thread(void (SocketConnection::*work)()) {
    return [weak = this->weak_from_this(), executor = stream_.get_executor(), work] {
      asio::post(executor, [weak, work] {
        if (const auto self = weak.lock()) ((*self).*work)();
      });
    };
  }

  void read() {
    if (server_.clients.is_full(client_)) return wait_for_answers();
    stream_.async_read(buffer_, [self = this->shared_from_this()](const error_code& error, std::size_t) {
      if (error) return self->leave();
      self->take_message();
    });
  }

  // What was sent waits in the system's buffers until calls are answered, which pump() hears of; not for ever, for a
  // browser that has gone would not be noticed.
  void wait_for_answers() {
    waiting_ = true;
    pause_.expires_after(seconds(server_.config.idle_timeout_s));
    pause_.async_wait([self = this->shared_from_this()](const error_code&) {
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
    const auto now = std::chrono::steady_clock::now();
    pointer_time_ = std::max(pointer_time_, now - kMostPointersAhead * kPointersApart);
    if (pointer_time_ > now) return false;
    pointer_time_ += kPointersApart;
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
    stream_.async_write(asio::buffer(*frame_.bytes),
                        [self = this->shared_from_this()](const error_code& error, std::size_t) {
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
    stream_.async_close(reason_, [self = this->shared_from_this()](const error_code&) {});
  }

  void leave() {
    leaving_ = true;
    pause_.cancel();
    if (client_ == 0) return;
    server_.sessions.remove_window(client_);
    if (server_.clients.leave(client_) && server_.events.left) server_.events.left(client_);
  }

  websocket::stream<Stream> stream_;
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

}  // namespace asperity::studio

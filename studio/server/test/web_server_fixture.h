#pragma once

#include <gmock/gmock.h>

#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <variant>

#include "asperity/studio/web_server.h"
#include "raw_client.h"

namespace asperity::studio {

// A server on a free port that answers a call "echo" with its arguments, "big" with a megabyte, and "never" not at all.
class WebServerSocket : public testing::Test {
 protected:
  void SetUp() override { start({}); }
  void start(const WebServerConfig& config) {
    server_.reset();
    is_tls_ = !config.tls_certificate.empty();
    WebServerEvents events;
    events.joined = [this](ClientId client) {
      ++joined_;
      newest_ = client;
      if (joining_fails_) throw std::bad_alloc();
    };
    events.left = [this](ClientId) { ++left_; };
    events.message = [this](ClientId client, const Message& message) {
      const Call* call = std::get_if<Call>(&message);
      if (call == nullptr) {
        pointer_sequence_ = std::get<Pointer>(message).sequence;
        ++pointers_;
      } else if (call->name == "big") {
        server_->answer(client, call->id, std::string(1U << 20U, 'b'));
      } else if (call->name == "never") {
        ++unanswered_;
      } else {
        server_->answer(client, call->id, call->args);
      }
    };
    server_ = WebServer::start(config, events);
    port_ = server_->port();
    host_ = "127.0.0.1:" + std::to_string(port_);
    cookie_ = session_cookie(port_, server_->address());
  }
  RawClient::Response ask(const std::string& request) const {
    RawClient client(port_);
    if (is_tls_ && !client.start_tls()) throw std::runtime_error("no TLS");
    client.send(request);
    return client.response();
  }
  RawClient::Response get(const std::string& target, const std::string& headers = "") const {
    return ask("GET " + target + " HTTP/1.1\r\nHost: " + host_ + "\r\nAccept-Encoding: gzip\r\n" + headers + "\r\n");
  }
  RawClient browser() const { return open_websocket(port_, cookie_, 0, is_tls_); }
  // True if calls of a browser are answered.
  bool answers(RawClient& client) const {
    client.send(RawClient::frame(1, R"({"id":9,"call":"echo","args":{}})"));
    const auto frame = client.next_frame();
    return frame && frame->payload == R"({"id":9,"result":{}})";
  }

  std::unique_ptr<WebServer> server_;
  int port_ = 0;
  bool is_tls_ = false;
  std::string host_, cookie_;
  std::atomic<int> joined_{0}, left_{0}, unanswered_{0}, pointers_{0};
  std::atomic<ClientId> newest_{0};
  std::atomic<bool> joining_fails_{false};
  std::atomic<std::uint32_t> pointer_sequence_{0};
};

}  // namespace asperity::studio

// The one translation unit with Beast, which takes long to compile.
// Asio's fences are for contexts of several threads; ours has one, and the thread sanitizer knows no fences.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
// Boost 1.74's Asio uses std::exchange without including its header.
#include <utility>

#include "asperity/studio/web_server.h"

#include <fcntl.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/zlib/inflate_stream.hpp>
#include <ctime>
#include <optional>
#include <thread>
#include <vector>

#include "answer_text.h"
#include "asperity/web/assets.h"
#include "http_connection.h"
#include "server_limits.h"
#include "server_state.h"
#include "tls_context.h"
#include "tls_door.h"

namespace asperity::studio {

namespace {

constexpr auto kAcceptPause = std::chrono::milliseconds(100);

std::string place(const WebServerConfig& config) { return config.host + ", port " + std::to_string(config.port); }

Error cannot_listen(const WebServerConfig& config, const error_code& error) {
  std::string why = error.message();
  if (error == asio::error::address_in_use) {
    why = "another program has this port, perhaps another studio; end it, or choose another port with --port";
  } else if (error == asio::error::access_denied) {
    why = "ports below 1024 are the administrator's; choose another with --port";
  } else if (error == boost::system::errc::address_not_available) {
    why = "this machine has no such address";
  }
  return Error("the studio cannot listen at " + place(config) + ": " + why);
}

// A program that is started, as the user's browser, must not hold the port or a connection after our end.
void keep_from_children(int socket) { fcntl(socket, F_SETFD, FD_CLOEXEC); }

tcp::acceptor listen_on(asio::io_context& context, const WebServerConfig& config) {
  error_code error;
  tcp::resolver resolver(context);
  const auto found = resolver.resolve(config.host, std::to_string(config.port), tcp::resolver::passive, error);
  if (error) throw cannot_listen(config, error);
  const tcp::endpoint endpoint = found.begin()->endpoint();
  tcp::acceptor acceptor(context);
  acceptor.open(endpoint.protocol(), error);
  if (!error) keep_from_children(acceptor.native_handle());
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error) throw cannot_listen(config, error);
  return acceptor;
}

// What this program was built with, so it is sound: ten bytes of head, deflate, a check sum and the length (RFC 1952).
std::string unpack_gzip(std::string_view gzip) {
  constexpr std::size_t kHead_bytes = 10, kTail_bytes = 8, kByte_bits = 8;
  std::size_t size = 0;
  for (std::size_t i = 0; i < sizeof(std::uint32_t); ++i)
    size |= std::size_t{static_cast<unsigned char>(gzip[gzip.size() - 4 + i])} << (kByte_bits * i);
  std::string out(size, '\0');
  beast::zlib::z_params step;
  step.next_in = gzip.data() + kHead_bytes;
  step.avail_in = gzip.size() - kHead_bytes - kTail_bytes;
  step.next_out = out.data();
  step.avail_out = out.size();
  beast::zlib::inflate_stream stream;
  error_code error;
  stream.write(step, beast::zlib::Flush::finish, error);
  out.resize(step.total_out);
  return out;
}

Site make_site(const WebServerConfig& config, int port) {
  const bool encrypted = !config.tls_certificate.empty();
  Site site{OwnHosts(config.host, port, encrypted), nullptr, {}, {}, unpack_gzip, config.documents};
  // Cookies know no ports: a second studio's would take this one's place. Of a name with the prefix browsers take a
  // cookie from an encrypted page alone.
  site.cookie_name = (encrypted ? "__Host-asperity_" : "asperity_") + std::to_string(port);
  site.asset = [](std::string_view path) { return web::find_asset(path); };
  return site;
}

class BeastServer : public WebServer {
 public:
  BeastServer(const WebServerConfig& config, const WebServerEvents& events)
      : acceptor_(listen_on(context_, config)), pause_(context_), port_(acceptor_.local_endpoint().port()) {
    set_up_tls(config);
    state_.emplace(config, events, make_site(config, port_));
    accept();
    thread_ = std::thread([this] { run(); });
  }
  ~BeastServer() override { BeastServer::stop(); }

  int port() const override { return port_; }
  std::string address() const override { return state_->site.hosts.address() + "/#token=" + state_->sessions.token(); }
  std::vector<std::string> warnings() const override { return warnings_; }
  void renew_token() override { state_->sessions.renew(); }
  std::vector<SessionInfo> sessions() const override { return state_->sessions.list(); }
  std::uint64_t session_of(ClientId client) const override { return state_->sessions.session_of(client); }
  bool close_session(std::uint64_t number) override { return state_->sessions.close(number); }
  std::uint64_t dropped_frames() const override { return state_->clients.dropped(); }

  void stop() override {
    context_.stop();
    if (thread_.joinable()) thread_.join();
    state_->is_over = true;
  }

  void publish(std::string_view topic, std::string frame, Delivery delivery) override {
    state_->clients.publish(topic, std::move(frame), delivery);
  }
  bool has_subscribers(std::string_view topic) const override { return state_->clients.has_subscribers(topic); }
  void broadcast(std::string_view event, const Json& data) override {
    state_->clients.send_all(event_text(event, data));
  }
  void notify(ClientId client, std::string_view event, const Json& data) override {
    state_->clients.send(client, event_text(event, data), true);
  }
  void answer(ClientId client, std::uint64_t id, const Json& result) override {
    end_call(client, id, answer_text(id, result), true);
  }
  void answer_block(ClientId client, std::uint64_t id, BlockWriter block) override {
    block.head()["id"] = id;
    end_call(client, id, block.take(), false);
  }
  void refuse(ClientId client, std::uint64_t id, std::string_view message, std::string_view hint) override {
    end_call(client, id, refusal_text(id, message, hint), true);
  }

 private:
  void set_up_tls(const WebServerConfig& config) {
    if (config.tls_certificate.empty() != config.tls_key.empty()) {
      throw Error("a certificate and its key go together: --tls-cert and --tls-key");
    }
    if (config.tls_certificate.empty()) return;
    TlsContext loaded = load_tls(config.tls_certificate, config.tls_key, config.host, std::time(nullptr));
    warnings_ = std::move(loaded.warnings);
    tls_.emplace(loaded.context.release());
  }

  void end_call(ClientId client, std::uint64_t id, std::string bytes, bool is_text) {
    state_->clients.end_call(client, id);
    state_->clients.send(client, std::move(bytes), is_text);
  }

  // What a handler throws (no memory) ends its connection, not the server.
  void run() {
    for (;;) {
      try {
        if (!listening_) accept();
        context_.run();
        return;
      } catch (const std::exception&) {
        continue;
      }
    }
  }

  void accept() {
    acceptor_.async_accept([this](const error_code& error, tcp::socket socket) {
      listening_ = false;
      // No file descriptor is free: one may be later.
      if (error) return accept_later();
      try {
        take(std::move(socket));
      } catch (const std::exception&) {
        // No memory for this browser; there may be for the next.
      }
      accept();
    });
    listening_ = true;
  }

  void accept_later() {
    pause_.expires_after(kAcceptPause);
    pause_.async_wait([this](const error_code& stopped) {
      listening_ = false;
      if (!stopped) accept();
    });
    listening_ = true;
  }

  void take(tcp::socket socket) {
    keep_from_children(socket.native_handle());
    if (state_->connections >= state_->config.max_clients + kMostHttpConnections) return;
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    if (tls_) {
      std::make_shared<TlsDoor>(std::move(socket), *state_, *tls_)->open();
    } else {
      std::make_shared<HttpConnection<PlainStream>>(PlainStream(std::move(socket)), *state_)->read();
    }
  }

  std::optional<asio::ssl::context> tls_;
  std::vector<std::string> warnings_;
  std::optional<ServerState> state_;  // outlives the connections, which go with the context
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  const int port_;
  bool listening_ = false;  // somebody is waited for, or the pause before that; its own thread alone, once that runs
  std::thread thread_;
};

}  // namespace

std::unique_ptr<WebServer> WebServer::start(const WebServerConfig& config, WebServerEvents events) {
  return std::make_unique<BeastServer>(config, events);
}

}  // namespace asperity::studio

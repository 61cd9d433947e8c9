// Asio's fences are for contexts of several threads; ours have one, and the thread sanitizer knows no fences.
#define BOOST_ASIO_DISABLE_FENCED_BLOCK
// Boost 1.74's Asio uses std::exchange without including its header.
#include <utility>

#include "inverse_service_client.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <optional>

#include "asperity/base/error.h"
#include "haply_protocol.h"

namespace asperity {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;
using tcp = asio::ip::tcp;

struct InverseServiceClient::Impl {
  Impl(std::string new_host, int new_port) : host(std::move(new_host)), port(std::to_string(new_port)) {}

  [[noreturn]] void fail(const std::string& what, const error_code& error) const {
    std::string reason = error.message();
    if (error == beast::error::timeout) reason = "no answer in time";
    if (error == beast::websocket::error::closed || error == asio::error::eof) reason = "closed by the service";
    if (error == asio::error::connection_refused) reason += "; is the Inverse Service running?";
    throw Error("haply: " + what + " " + host + ":" + port + ": " + reason);
  }

  tcp::resolver::results_type resolve() {
    error_code error;
    tcp::resolver resolver(context);
    auto found = resolver.resolve(host, port, error);
    if (error) fail("cannot find", error);
    return found;
  }

  // Starts an operation and runs the context until its handler was called.
  template <class Start>
  error_code wait_for(Start start) {
    std::optional<error_code> result;
    start([&result](const error_code& error, auto&&...) { result = error; });
    while (!result) context.run_one();
    return *result;
  }

  void start_read() {
    reading = true;
    read_error.reset();
    socket->async_read(buffer, [this](const error_code& error, std::size_t) {
      reading = false;
      read_error = error;
    });
  }

  std::string host, port;
  asio::io_context context{1};
  asio::executor_work_guard<asio::io_context::executor_type> never_out_of_work{context.get_executor()};
  asio::steady_timer timer{context};
  std::optional<beast::websocket::stream<beast::tcp_stream>> socket;
  beast::flat_buffer buffer;
  bool reading = false;
  std::optional<error_code> read_error;  // of the read that ended and was not taken
  std::uint64_t waits = 0;
};

InverseServiceClient::InverseServiceClient(std::string host, int port)
    : impl_(std::make_unique<Impl>(std::move(host), port)) {}

InverseServiceClient::~InverseServiceClient() = default;

std::string InverseServiceClient::get(const std::string& path, Clock::time_point until) {
  namespace http = beast::http;
  Impl& my = *impl_;
  const auto endpoints = my.resolve();
  beast::tcp_stream stream(my.context);
  stream.expires_at(until);
  error_code error = my.wait_for([&](auto done) { stream.async_connect(endpoints, done); });
  if (error) my.fail("cannot connect to", error);
  http::request<http::empty_body> request(http::verb::get, path, 11);
  request.set(http::field::host, my.host);
  error = my.wait_for([&](auto done) { http::async_write(stream, request, done); });
  if (error) my.fail("cannot send GET " + path + " to", error);
  beast::flat_buffer bytes;
  http::response_parser<http::string_body> response;
  response.body_limit(kMostFrame_bytes);
  error = my.wait_for([&](auto done) { http::async_read(stream, bytes, response, done); });
  if (error) my.fail("no answer to GET " + path + " from", error);
  if (response.get().result() != http::status::ok) {
    throw Error("haply: GET " + path + ": status " + std::to_string(response.get().result_int()));
  }
  return std::move(response.get().body());
}

void InverseServiceClient::connect(Clock::time_point until) {
  Impl& my = *impl_;
  const auto endpoints = my.resolve();
  auto& socket = my.socket.emplace(my.context);
  auto& stream = beast::get_lowest_layer(socket);
  stream.expires_at(until);
  error_code error = my.wait_for([&](auto done) { stream.async_connect(endpoints, done); });
  if (error) my.fail("cannot connect to", error);
  // Small messages to and fro: without this each waits for the other side's acknowledgement.
  stream.socket().set_option(tcp::no_delay(true), error);
  socket.read_message_max(kMostFrame_bytes);
  error = my.wait_for([&](auto done) { socket.async_handshake(my.host + ":" + my.port, "/", done); });
  if (error) my.fail("no WebSocket at", error);
  stream.expires_never();
  socket.text(true);
  my.start_read();
}

void InverseServiceClient::send(std::string_view text, Clock::time_point until) {
  Impl& my = *impl_;
  // What the service did not take by then it never will; a read that is under way ends with it.
  bool late = false;
  asio::steady_timer deadline(my.context, until);
  deadline.async_wait([&](const error_code& cancelled) {
    if (cancelled) return;
    late = true;
    beast::get_lowest_layer(*my.socket).close();
  });
  const error_code error =
      my.wait_for([&](auto done) { my.socket->async_write(asio::buffer(text.data(), text.size()), done); });
  deadline.cancel();
  my.context.poll();
  if (late) my.fail("cannot send to", beast::error::timeout);
  if (error) my.fail("cannot send to", error);
}

bool InverseServiceClient::receive(std::string& text, Clock::time_point until, const std::atomic<bool>& stop) {
  Impl& my = *impl_;
  if (!my.reading && !my.read_error) my.start_read();
  const std::uint64_t wait = ++my.waits;
  bool over = false;
  my.timer.expires_at(until);
  my.timer.async_wait([&my, &over, wait](const error_code& cancelled) {
    if (!cancelled && my.waits == wait) over = true;
  });
  while (!my.read_error && !over && !stop.load(std::memory_order_relaxed)) my.context.run_one();
  ++my.waits;
  my.timer.cancel();
  my.context.poll();
  if (!my.read_error) return false;
  if (*my.read_error) my.fail("connection to", *my.read_error);
  text = beast::buffers_to_string(my.buffer.data());
  my.buffer.consume(my.buffer.size());
  my.start_read();
  return true;
}

void InverseServiceClient::wake() noexcept {
  try {
    asio::post(impl_->context, [] {});
  } catch (const std::exception&) {
    // No memory for a word: the wait ends by itself at its time.
  }
}

int InverseServiceClient::descriptor() const noexcept {
  if (!impl_->socket) return -1;
  return beast::get_lowest_layer(*impl_->socket).socket().native_handle();
}

void InverseServiceClient::close(Clock::time_point until) noexcept {
  Impl& my = *impl_;
  if (!my.socket) return;
  try {
    bool closed = false, over = false;
    asio::steady_timer deadline(my.context, until);
    deadline.async_wait([&](const error_code&) { over = true; });
    my.socket->async_close(beast::websocket::close_code::normal, [&](const error_code&) { closed = true; });
    while (!closed && !over) my.context.run_one();
    deadline.cancel();
    beast::get_lowest_layer(*my.socket).close();
    while (!closed || !over || my.reading) my.context.run_one();
  } catch (const std::exception&) {
    // The socket goes with this object in any case.
  }
}

}  // namespace asperity

#include "raw_client.h"

#include <netinet/in.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace asperity::studio {

namespace {

constexpr int kPatience_ms = 10'000;

void wait_for(int socket, short event) {
  pollfd watched{socket, event, 0};
  if (poll(&watched, 1, kPatience_ms) <= 0) throw std::runtime_error("nothing came for ten seconds");
}

}  // namespace

RawClient::RawClient(int port, int receive_buffer_bytes) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  if (receive_buffer_bytes > 0) {
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("cannot connect");
  }
}

RawClient::~RawClient() {
  SSL_free(tls_);
  if (socket_ >= 0) close(socket_);
}

RawClient::RawClient(RawClient&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      tls_(std::exchange(other.tls_, nullptr)),
      received_(std::move(other.received_)) {}

bool RawClient::start_tls(int version) {
  const timeval patience{kPatience_ms / 1000, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  SSL_CTX* context = SSL_CTX_new(TLS_client_method());
  SSL_CTX_set_security_level(context, 0);  // old versions too: it is the server who must refuse them
  tls_ = SSL_new(context);
  SSL_CTX_free(context);
  if (version != 0) {
    SSL_set_min_proto_version(tls_, version);
    SSL_set_max_proto_version(tls_, version);
  }
  SSL_set_fd(tls_, socket_);
  return SSL_connect(tls_) == 1;
}

bool RawClient::send(std::string_view bytes) {
  if (tls_ != nullptr) return bytes.empty() || SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size())) > 0;
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      wait_for(socket_, POLLOUT);
      continue;
    }
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(sent));
  }
  return true;
}

bool RawClient::fill() {
  char buffer[65536];
  if (tls_ == nullptr || SSL_pending(tls_) == 0) wait_for(socket_, POLLIN);
  const ssize_t got = tls_ != nullptr ? SSL_read(tls_, buffer, sizeof buffer) : recv(socket_, buffer, sizeof buffer, 0);
  if (got <= 0) return false;
  received_.append(buffer, static_cast<std::size_t>(got));
  return true;
}

bool RawClient::need(std::size_t bytes) {
  while (received_.size() < bytes) {
    if (!fill()) return false;
  }
  return true;
}

std::string RawClient::Response::header(std::string_view name) const {
  const std::string start = "\r\n" + std::string(name) + ": ";
  const auto at = head.find(start);
  if (at == std::string::npos) return {};
  const auto begin = at + start.size();
  return head.substr(begin, head.find("\r\n", begin) - begin);
}

RawClient::Response RawClient::response() {
  std::size_t end = 0;
  while ((end = received_.find("\r\n\r\n")) == std::string::npos) {
    if (!fill()) throw std::runtime_error("closed before an answer");
  }
  Response out;
  out.head = received_.substr(0, end + 2);
  received_.erase(0, end + 4);
  out.status = std::atoi(out.head.substr(9, 3).c_str());
  const std::string length = out.header("Content-Length");
  if (length.empty()) return out;
  const auto bytes = static_cast<std::size_t>(std::atoll(length.c_str()));
  if (!need(bytes)) throw std::runtime_error("closed within an answer");
  out.body = received_.substr(0, bytes);
  received_.erase(0, bytes);
  return out;
}

bool RawClient::closes() {
  while (fill()) received_.clear();
  return true;
}

std::string RawClient::frame(unsigned opcode, std::string_view payload, bool final, bool masked) {
  std::string out;
  out += static_cast<char>((final ? 0x80U : 0U) | opcode);
  const unsigned mask_bit = masked ? 0x80U : 0U;
  const std::size_t size = payload.size();
  const int length_bytes = size < 126 ? 0 : size < 65536 ? 2 : 8;
  out += static_cast<char>(mask_bit | (length_bytes == 0 ? size : length_bytes == 2 ? 126U : 127U));
  for (int i = length_bytes - 1; i >= 0; --i) out += static_cast<char>(size >> (8 * i));
  constexpr char kMask[] = {0x12, 0x34, 0x56, 0x78};
  if (masked) out.append(kMask, 4);
  for (std::size_t i = 0; i < size; ++i) {
    out += masked ? static_cast<char>(payload[i] ^ kMask[i % 4]) : payload[i];
  }
  return out;
}

int RawClient::Frame::close_code() const {
  if (payload.size() < 2) return 0;
  return 256 * static_cast<unsigned char>(payload[0]) + static_cast<unsigned char>(payload[1]);
}

std::optional<RawClient::Frame> RawClient::next_frame() {
  for (;;) {
    if (!need(2)) return std::nullopt;
    const auto byte = [this](std::size_t i) { return static_cast<unsigned char>(received_[i]); };
    const unsigned opcode = byte(0) & 0x0FU;
    const unsigned shortest = byte(1);
    const std::size_t length_bytes = shortest < 126 ? 0 : shortest == 126 ? 2 : 8;
    if (!need(2 + length_bytes)) return std::nullopt;
    std::size_t size = length_bytes == 0 ? shortest : 0;
    for (std::size_t i = 0; i < length_bytes; ++i) size = 256 * size + byte(2 + i);
    if (!need(2 + length_bytes + size)) return std::nullopt;
    Frame out{opcode, received_.substr(2 + length_bytes, size)};
    received_.erase(0, 2 + length_bytes + size);
    constexpr unsigned kPing = 9, kPong = 10;
    if (opcode != kPing) return out;
    send(frame(kPong, out.payload));
  }
}

std::string upgrade_request(int port, std::string_view headers) {
  return "GET /ws HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
         "Sec-WebSocket-Version: 13\r\n" +
         std::string(headers) + "\r\n";
}

std::string session_cookie(int port, const std::string& address) {
  const std::string host = "127.0.0.1:" + std::to_string(port);
  const bool is_tls = address.starts_with("https:");
  const std::string body = "{\"token\":\"" + address.substr(address.find("token=") + 6) + "\"}";
  RawClient client(port);
  if (is_tls && !client.start_tls()) throw std::runtime_error("no TLS");
  client.send("POST /session HTTP/1.1\r\nHost: " + host + "\r\nOrigin: " + (is_tls ? "https://" : "http://") + host +
              "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
  const std::string cookie = client.response().header("Set-Cookie");
  return cookie.substr(0, cookie.find(';'));
}

RawClient open_websocket(int port, const std::string& cookie, int receive_buffer_bytes, bool is_tls) {
  RawClient client(port, receive_buffer_bytes);
  if (is_tls && !client.start_tls()) throw std::runtime_error("no TLS");
  client.send(upgrade_request(port, std::string("Origin: ") + (is_tls ? "https" : "http") +
                                        "://127.0.0.1:" + std::to_string(port) + "\r\nCookie: " + cookie + "\r\n"));
  if (client.response().status != 101) throw std::runtime_error("no WebSocket");
  return client;
}

}  // namespace asperity::studio

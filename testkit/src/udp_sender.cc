#include "asperity/testkit/udp_sender.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

namespace asperity::testkit {

namespace {

sockaddr_in loopback(int port) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(static_cast<std::uint16_t>(port));
  out.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return out;
}

}  // namespace

UdpSender::UdpSender() : file_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const sockaddr_in any = loopback(0);
  if (::bind(file_, reinterpret_cast<const sockaddr*>(&any), sizeof any) != 0) throw std::runtime_error("no socket");
}

UdpSender::~UdpSender() { ::close(file_); }

void UdpSender::send(int port, const std::vector<std::uint8_t>& bytes) const {
  const sockaddr_in to = loopback(port);
  const auto sent = ::sendto(file_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  if (sent != static_cast<ssize_t>(bytes.size())) throw std::runtime_error("a datagram was not sent");
}

void UdpSender::send_text(int port, std::string_view text) const {
  send(port, std::vector<std::uint8_t>(text.begin(), text.end()));
}

std::vector<std::uint8_t> UdpSender::receive() const {
  std::vector<std::uint8_t> out(65536);
  const auto got = ::recv(file_, out.data(), out.size(), 0);
  if (got < 0) throw std::runtime_error("no datagram");
  out.resize(static_cast<std::size_t>(got));
  return out;
}

int port_in(const std::string& name) { return std::stoi(name.substr(name.rfind(':') + 1)); }

}  // namespace asperity::testkit

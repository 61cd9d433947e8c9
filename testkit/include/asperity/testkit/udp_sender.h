#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::testkit {

// A sender of datagrams on the loopback, from a port of its own. Throws std::runtime_error if the system refuses.
class UdpSender {
 public:
  UdpSender();
  ~UdpSender();
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  void send(int port, const std::vector<std::uint8_t>& bytes) const;
  void send_text(int port, std::string_view text) const;
  // Waits for a datagram.
  std::vector<std::uint8_t> receive() const;

 private:
  int file_;
};

// The port in the name of a source, "udp:127.0.0.1:9000".
int port_in(const std::string& name);

}  // namespace asperity::testkit

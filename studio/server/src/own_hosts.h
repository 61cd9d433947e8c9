#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace asperity::studio {

// The names under which a server is reached, as browsers write them in Host. A page of a stranger's name that was made
// to resolve to this machine (DNS rebinding) has its own name there.
class OwnHosts {
 public:
  // `host` is the address or name that the server listens at; encrypted, its pages are of https.
  OwnHosts(const std::string& host, int port, bool encrypted = false);

  // The exact text of a Host header: "127.0.0.1:8137". Where the server listens at all addresses, any number is its
  // own, for a number cannot be made to resolve elsewhere.
  bool contains(std::string_view host_header) const;
  // The Origin of a page that was served under that Host.
  bool is_own_origin(std::string_view origin, std::string_view host_header) const;

  // Where a page that was served under that Host opens its WebSocket: "ws://127.0.0.1:8137".
  std::string socket_origin(std::string_view host_header) const;

  // "http://127.0.0.1:8137", to be opened on this machine.
  std::string address() const;
  bool is_encrypted() const { return encrypted_; }

 private:
  bool any_number_ = false;
  bool encrypted_ = false;
  std::string port_;
  std::vector<std::string> names_;  // with the port
  std::string address_;
};

}  // namespace asperity::studio

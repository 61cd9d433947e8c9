#include "own_hosts.h"

#include <algorithm>
#include <cctype>

#include <arpa/inet.h>

#include "asperity/studio/web_server.h"

namespace asperity::studio {

namespace {

enum class Family { kName, kV4, kV6 };

Family family(const std::string& host) {
  in6_addr bytes{};
  if (inet_pton(AF_INET, host.c_str(), &bytes) == 1) return Family::kV4;
  return inet_pton(AF_INET6, host.c_str(), &bytes) == 1 ? Family::kV6 : Family::kName;
}

std::string as_in_address(const std::string& host) { return family(host) == Family::kV6 ? "[" + host + "]" : host; }

std::string to_lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return out;
}

bool is_number(std::string_view host) {
  if (host.find('\0') != std::string_view::npos) return false;
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) return family(std::string(host.substr(1, host.size() - 2))) == Family::kV6;
  return family(std::string(host)) == Family::kV4;
}

}  // namespace

bool is_this_machine_only(const std::string& host) {
  if (to_lower(host) == "localhost") return true;
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24U) == 127;
  in6_addr v6{};
  return inet_pton(AF_INET6, host.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

OwnHosts::OwnHosts(const std::string& host, int port, bool encrypted)
    : encrypted_(encrypted), port_(":" + std::to_string(port)) {
  const int default_port = encrypted ? 443 : 80;
  in6_addr v6{};
  any_number_ = host == "0.0.0.0" || (inet_pton(AF_INET6, host.c_str(), &v6) == 1 && IN6_IS_ADDR_UNSPECIFIED(&v6));
  for (const std::string& name :
       {std::string("127.0.0.1"), std::string("localhost"), std::string("[::1]"), to_lower(as_in_address(host))}) {
    names_.push_back(name + port_);
    if (port == default_port) names_.push_back(name);
  }
  address_ = (encrypted ? "https://" : "http://") + (any_number_ ? "127.0.0.1" : as_in_address(host)) + port_;
}

bool OwnHosts::contains(std::string_view host_header) const {
  const std::string host = to_lower(host_header);
  if (std::find(names_.begin(), names_.end(), host) != names_.end()) return true;
  return any_number_ && host.ends_with(port_) &&
         is_number(std::string_view(host).substr(0, host.size() - port_.size()));
}

bool OwnHosts::is_own_origin(std::string_view origin, std::string_view host_header) const {
  return contains(host_header) && to_lower(origin) == (encrypted_ ? "https://" : "http://") + to_lower(host_header);
}

std::string OwnHosts::socket_origin(std::string_view host_header) const {
  return (encrypted_ ? "wss://" : "ws://") + std::string(host_header);
}

std::string OwnHosts::address() const { return address_; }

}  // namespace asperity::studio

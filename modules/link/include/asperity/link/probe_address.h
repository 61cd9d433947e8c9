#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "asperity/link/probe_decoder.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

enum class ProbeLinkKind { kSerial, kUsb, kUdp, kFile };

// Where a probe is, as people type it (docs/probe-links.md).
struct ProbeAddress {
  ProbeLinkKind kind = ProbeLinkKind::kSerial;
  std::string path;                   // serial: the port; file: the capture
  std::uint16_t vendor = 0;           // usb
  std::uint16_t product = 0;          // usb
  std::string serial_number;          // usb; empty: any
  std::string address = "127.0.0.1";  // udp: of this host, to bind; 0.0.0.0 hears all who reach it
  std::uint16_t port = 0;             // udp
  int baud = 0;                       // serial, usb; 0: the protocol's
  double bytes_per_s = 0.0;           // file; 0: as its arrivals say
};

// Reads "serial:PATH[@BAUD]", "usb:VID:PID[:SERIAL][@BAUD]" (hexadecimal), "udp:[ADDRESS:]PORT" or
// "file:PATH[@BYTES_PER_SECOND]". Throws Error naming the text and what is allowed.
ProbeAddress parse_probe_address(std::string_view text);

// Opens what the address names. Throws Error naming it and what to do.
std::unique_ptr<ByteSource> open_probe_source(const ProbeAddress& address, ProbeProtocol protocol);

}  // namespace asperity

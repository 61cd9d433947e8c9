#include "asperity/link/probe_address.h"

#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/link/open_capture.h"
#include "asperity/transport/find_usb_serial.h"
#include "asperity/transport/open_serial.h"
#include "asperity/transport/open_udp.h"

namespace asperity {

namespace {

constexpr std::int64_t kMaxBaud = 20'000'000;

[[noreturn]] void refuse(std::string_view text, const std::string& why) {
  throw Error(
      fmt::format("probe '{}': {}; use serial:PORT[@BAUD], usb:VENDOR:PRODUCT[:SERIAL][@BAUD], udp:[ADDRESS:]PORT or "
                  "file:CAPTURE[@BYTES_PER_SECOND]",
                  printable(text, 200), why));
}

// What is behind the last '@' of `rest`, which it is taken from.
std::optional<std::string_view> take_suffix(std::string_view& rest) {
  const auto at = rest.rfind('@');
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view suffix = rest.substr(at + 1);
  rest = rest.substr(0, at);
  return suffix;
}

int baud_of(std::string_view text, std::optional<std::string_view> suffix) {
  if (!suffix) return 0;
  const auto baud = parse_int64(*suffix);
  if (!baud || *baud < 50 || *baud > kMaxBaud) refuse(text, fmt::format("'{}' is not a baud rate", printable(*suffix)));
  return static_cast<int>(*baud);
}

std::uint16_t usb_number(std::string_view text, std::string_view digits) {
  std::uint32_t value = 0;
  bool sound = !digits.empty() && digits.size() <= 4;
  for (const char c : digits) {
    const auto digit = std::string_view("0123456789abcdef").find(static_cast<char>(c >= 'A' && c <= 'F' ? c + 32 : c));
    sound = sound && digit != std::string_view::npos;
    value = 16 * value + static_cast<std::uint32_t>(sound ? digit : 0);
  }
  if (!sound)
    refuse(text, fmt::format("'{}' is not a USB number of at most four hexadecimal digits", printable(digits)));
  return static_cast<std::uint16_t>(value);
}

void parse_usb(std::string_view text, std::string_view rest, ProbeAddress& out) {
  out.baud = baud_of(text, take_suffix(rest));
  const auto first = rest.find(':');
  if (first == std::string_view::npos) refuse(text, "the product is missing");
  const auto second = rest.find(':', first + 1);
  out.vendor = usb_number(text, rest.substr(0, first));
  out.product =
      usb_number(text, rest.substr(first + 1, second == std::string_view::npos ? second : second - first - 1));
  if (second == std::string_view::npos) return;
  out.serial_number = rest.substr(second + 1);
  if (out.serial_number.empty()) refuse(text, "the serial number is empty");
}

void parse_udp(std::string_view text, std::string_view rest, ProbeAddress& out) {
  const auto colon = rest.rfind(':');
  const std::string_view digits = colon == std::string_view::npos ? rest : rest.substr(colon + 1);
  const auto port = parse_int64(digits);
  if (!port || *port < 1 || *port > std::numeric_limits<std::uint16_t>::max()) {
    refuse(text, fmt::format("'{}' is not a port from 1 to 65535", printable(digits)));
  }
  out.port = static_cast<std::uint16_t>(*port);
  if (colon == std::string_view::npos) return;
  std::string_view address = rest.substr(0, colon);
  if (address.starts_with('[') && address.ends_with(']')) address = address.substr(1, address.size() - 2);
  if (address.empty()) refuse(text, "the address is empty");
  out.address = address;
}

void parse_file(std::string_view text, std::string_view rest, ProbeAddress& out) {
  if (const auto suffix = take_suffix(rest)) {
    const auto rate = parse_double(*suffix);
    if (!rate || !std::isfinite(*rate) || *rate < 1.0 || *rate > 1e9) {
      refuse(text, fmt::format("'{}' is not a byte rate from 1 to 1e9", printable(*suffix)));
    }
    out.bytes_per_s = *rate;
  }
  out.path = rest;
}

}  // namespace

ProbeAddress parse_probe_address(std::string_view text) {
  ProbeAddress out;
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) refuse(text, "does not say what it is");
  const std::string_view scheme = text.substr(0, colon);
  std::string_view rest = text.substr(colon + 1);
  if (scheme == "serial") {
    out.kind = ProbeLinkKind::kSerial;
    out.baud = baud_of(text, take_suffix(rest));
    out.path = rest;
  } else if (scheme == "usb") {
    out.kind = ProbeLinkKind::kUsb;
    parse_usb(text, rest, out);
  } else if (scheme == "udp") {
    out.kind = ProbeLinkKind::kUdp;
    parse_udp(text, rest, out);
  } else if (scheme == "file") {
    out.kind = ProbeLinkKind::kFile;
    parse_file(text, rest, out);
  } else {
    refuse(text, fmt::format("'{}' is not a kind of link", printable(scheme)));
  }
  const bool has_path = scheme == "serial" || scheme == "file";
  if (has_path && (out.path.empty() || out.path.find('\0') != std::string::npos)) refuse(text, "the name is missing");
  return out;
}

std::unique_ptr<ByteSource> open_probe_source(const ProbeAddress& address, ProbeProtocol protocol) {
  const int baud = address.baud != 0 ? address.baud : default_baud(protocol);
  switch (address.kind) {
    case ProbeLinkKind::kUsb:
      return open_serial(find_usb_serial({address.vendor, address.product, address.serial_number}), baud);
    case ProbeLinkKind::kUdp: {
      UdpConfig config;
      config.address = address.address;
      config.port = address.port;
      config.shows_sender = [protocol](std::span<const std::uint8_t> datagram) {
        const auto decoder = make_probe_decoder(protocol);
        std::vector<ProbeSample> samples;
        decoder->push(datagram, host_now_ns(), samples);
        return decoder->statistics().frames > 0 || decoder->description().has_value();
      };
      return open_udp(config);
    }
    case ProbeLinkKind::kFile: {
      CaptureConfig config;
      config.bytes_per_s = address.bytes_per_s;
      return open_capture(address.path, config);
    }
    case ProbeLinkKind::kSerial:
      break;
  }
  return open_serial(address.path, baud);
}

}  // namespace asperity

#include "asperity/link/probe_link.h"

#include <utility>

#include "asperity/base/host_clock.h"
#include "asperity/link/open_protocol.h"

namespace asperity {

namespace {

constexpr std::size_t kRead_bytes = 16384;
constexpr std::int64_t kAsk_ns = 1'000'000'000;

// Seed §3.1: 8 bits a sensor, ±2 g with about 0.015 g a count, 0 to 4.9 N with about 0.019 N a count, 500 Hz.
ProbeDescription what_description() {
  ProbeDescription out;
  out.model = "what";
  out.rate_Hz = 500.0;
  out.adc_max = 255.0;
  out.accel_counts_per_mps2 = 1.0 / (0.015 * 9.80665);
  out.force_rate_Hz = 500.0;
  out.force_newton_per_count = 0.019;
  return out;
}

}  // namespace

ProbeLink::ProbeLink(std::unique_ptr<ByteSource> source, ProbeProtocol protocol)
    : source_(std::move(source)),
      protocol_(protocol),
      decoder_(make_probe_decoder(protocol)),
      buffer_(kRead_bytes),
      next_request_ns_(host_now_ns() + kAsk_ns) {}

std::size_t ProbeLink::read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) {
  const Arrival arrival = source_->read(buffer_, timeout);
  if (arrival.count > 0) decoder_->push({buffer_.data(), arrival.count}, arrival.arrival_ns, out);
  if (protocol_ == ProbeProtocol::kOpen && !decoder_->description()) ask();
  return arrival.count;
}

void ProbeLink::ask() {
  const std::int64_t now_ns = host_now_ns();
  if (now_ns < next_request_ns_) return;
  next_request_ns_ = now_ns + kAsk_ns;
  // A zero byte first ends what noise on the probe's side may have begun.
  std::vector<std::uint8_t> request{0};
  append_open_request(request);
  source_->write(request);
}

std::optional<ProbeDescription> ProbeLink::description() const {
  if (protocol_ == ProbeProtocol::kWhat) return what_description();
  return decoder_->description();
}

}  // namespace asperity

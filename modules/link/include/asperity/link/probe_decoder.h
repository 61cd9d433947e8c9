#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "asperity/link/link_statistics.h"
#include "asperity/link/probe_description.h"
#include "asperity/recording/recording_appender.h"

namespace asperity {

inline constexpr std::array<std::string_view, 2> kProbeProtocolNames = {"what", "open"};
enum class ProbeProtocol { kWhat, kOpen };

// Turns a probe's bytes into samples. Any bytes are survived; memory is bounded.
class ProbeDecoder {
 public:
  virtual ~ProbeDecoder() = default;

  // Appends to `out` the samples that `bytes`, which arrived at `arrival_ns`, complete. Times of samples
  // are on the host's clock and rise strictly over all calls.
  virtual void push(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns, std::vector<ProbeSample>& out) = 0;

  virtual const LinkStatistics& statistics() const = 0;

  // The probe's description of itself; nullopt until it has, or for a kind that never does.
  virtual std::optional<ProbeDescription> description() const = 0;
};

std::unique_ptr<ProbeDecoder> make_probe_decoder(ProbeProtocol protocol);

// The bits per second of a serial line to such a probe, where none is stated: 115,200 (thesis §3.1) and 921,600.
int default_baud(ProbeProtocol protocol) noexcept;

}  // namespace asperity

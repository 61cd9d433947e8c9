#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/link/probe_decoder.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

// A probe: where its bytes come from and what they mean. One thread at a time.
class ProbeLink {
 public:
  ProbeLink(std::unique_ptr<ByteSource> source, ProbeProtocol protocol);

  // Waits at most `timeout` for bytes and appends the samples that they complete; gives the number of bytes. An open
  // probe that has not described itself for a second is asked to. Throws LinkLost when no more can come, Error for
  // anything else that fails; what was received before is in `out` and counted.
  std::size_t read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout);

  const LinkStatistics& statistics() const { return decoder_->statistics(); }

  // The probe's description of itself, or that of its kind.
  std::optional<ProbeDescription> description() const;

  ProbeProtocol protocol() const { return protocol_; }
  std::string name() const { return source_->name(); }

 private:
  void ask();

  std::unique_ptr<ByteSource> source_;
  ProbeProtocol protocol_;
  std::unique_ptr<ProbeDecoder> decoder_;
  std::vector<std::uint8_t> buffer_;
  std::int64_t next_request_ns_ = 0;
};

}  // namespace asperity

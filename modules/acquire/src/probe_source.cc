#include "asperity/acquire/probe_source.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace asperity {

namespace {

class DecodedProbe : public ProbeSource {
 public:
  DecodedProbe(std::unique_ptr<ByteSource> bytes, std::unique_ptr<ProbeDecoder> decoder)
      : bytes_(std::move(bytes)), decoder_(std::move(decoder)) {}

  void read(std::vector<ProbeSample>& out, std::chrono::milliseconds timeout) override {
    const Arrival arrival = bytes_->read(buffer_, timeout);
    if (arrival.count > 0) decoder_->push(std::span(buffer_).first(arrival.count), arrival.arrival_ns, out);
  }

  LinkStatistics statistics() const override { return decoder_->statistics(); }
  std::optional<ProbeDescription> description() const override { return decoder_->description(); }
  std::string name() const override { return bytes_->name(); }

 private:
  std::unique_ptr<ByteSource> bytes_;
  std::unique_ptr<ProbeDecoder> decoder_;
  std::array<std::uint8_t, 65536> buffer_{};
};

}  // namespace

std::unique_ptr<ProbeSource> make_probe_source(std::unique_ptr<ByteSource> bytes,
                                               std::unique_ptr<ProbeDecoder> decoder) {
  return std::make_unique<DecodedProbe>(std::move(bytes), std::move(decoder));
}

}  // namespace asperity

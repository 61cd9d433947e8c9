// A payload is refused, or written again gives itself but for what is ignored; any bytes come back through COBS; no
// block is read past its end.
#include <algorithm>

#include "asperity/link/cobs.h"
#include "asperity/link/open_protocol.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> input(data, size);
  std::vector<std::uint8_t> block;
  append_cobs(input, block);
  must(std::find(block.begin(), block.end(), 0) == block.end() && block.size() <= cobs_bound(size));
  std::vector<std::uint8_t> back(size);
  must(decode_cobs(block, back) == size && std::equal(back.begin(), back.end(), input.begin()));

  OpenPayload room;
  open_block_payload(input, room);

  OpenSamples samples;
  if (!parse_open_samples(input, samples)) return 0;
  must(samples.row_count <= kOpenMaxRows && samples.force_count <= kOpenMaxForces);
  std::vector<std::uint8_t> frame;
  append_open_samples(samples, frame);
  const auto payload = open_block_payload(std::span(frame).first(frame.size() - 1), room);
  must(payload.has_value() && payload->size() == size);
  must(std::equal(payload->begin() + 8, payload->end(), input.begin() + 8));
  return 0;
}

#include "fuzz_decoder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  asperity::fuzz_decoder(asperity::ProbeProtocol::kWhat, data, size);
  return 0;
}

#include "asperity/link/probe_decoder.h"
#include "open_decoder.h"
#include "what_decoder.h"

namespace asperity {

std::unique_ptr<ProbeDecoder> make_probe_decoder(ProbeProtocol protocol) {
  if (protocol == ProbeProtocol::kWhat) return std::make_unique<WhatDecoder>();
  return std::make_unique<OpenDecoder>();
}

int default_baud(ProbeProtocol protocol) noexcept { return protocol == ProbeProtocol::kWhat ? 115200 : 921600; }

}  // namespace asperity

#pragma once

#include "asperity/texture/autoregressive.h"

namespace asperity {

struct ConvertRateConfig {
  double rate_Hz = 1000.0;
  int order = 0;

  template <class V>
  void visit(V& v) {
    v.field("rate_Hz", rate_Hz, "the servo's rate, at which the texture is to be played", {1.0, 1e6});
    v.field("order", order,
            "of the filters at that rate; 0: the texture's, times the ratio of the rates if it rises, at most 32",
            {0, 32});
  }
};

// The texture for a servo of another rate: each model's spectrum up to half the lower of the two rates is kept,
// what lies above half the new rate is left out instead of folded, and a new all-pole filter is made of it by
// Levinson's recursion from the autocovariance at the new rate. Where the rate rises, the new range above the old half
// rate is filled 40 dB below the model's mean density (an all-pole filter cannot be empty there). A numerator is
// absorbed. The variance within the common range is kept to rounding, 0.01 % apart where the rate rises. Throws Error
// for a rate out of range or a texture that was not prepared.
AutoregressiveTexture convert_rate(const AutoregressiveTexture& texture, const ConvertRateConfig& config = {});

}  // namespace asperity

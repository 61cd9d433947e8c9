#pragma once

#include "asperity/texture/fourier1d.h"
#include "block_json.h"

namespace asperity {

// A Fourier series, wherever it stands in a texture file.
Fourier1d read_fourier1d(JsonObject& series);

// Throws Error unless there are as many cosine as sine coefficients, and some.
void check_fourier1d(const Fourier1d& f);

}  // namespace asperity

#pragma once

#include <string>

#include "asperity/texture/fourier1d.h"
#include "located_json.h"

namespace asperity {

// A Fourier series at `path`, wherever it stands in a texture file.
Fourier1d read_fourier1d(const LocatedJson& json, const std::string& path);

// Throws Error unless there are as many cosine as sine coefficients, and some.
void check_fourier1d(const Fourier1d& f);

}  // namespace asperity

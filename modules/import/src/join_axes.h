#pragma once

#include <vector>

namespace asperity {

// Axes of one length as one series with their joint power, their means taken off (DFT321; Landin, Romano, McMahan and
// Kuchenbecker 2010): |X| = √Σ|X_i|², the phase that of Σ X_i.
std::vector<double> join_axes(std::vector<std::vector<double>> axes);

}  // namespace asperity

#pragma once

#include <vector>

namespace asperity {

// A quantity of each piece of a surface's lines: [line][piece].
using PiecesOfLines = std::vector<std::vector<double>>;

// Their mean; nan if there is none.
double mean_of_pieces(const PiecesOfLines& pieces);

// Half of the 95 % interval (Student's t) of mean(b) − mean(a), by the scatter of the pieces. Both of one form are
// compared piece by piece, b scaled to the mean of a, so that what both have in common does not count; others are taken
// for independent. Lines that are like their neighbours, as those of a map, count as fewer: by the sum of the
// autocorrelation across the lines up to its first value that is not positive. `overlap`: what the overlap of the
// pieces adds to the variance of the mean, 1 for none. nan if a piece is nan, or fewer than two are independent.
double difference_interval(const PiecesOfLines& a, const PiecesOfLines& b, double overlap);

}  // namespace asperity

#pragma once

#include <vector>

#include "inertial_model.h"

// The filter: what it keeps of every epoch for the smoother to run back over.
namespace asperity::inertial_smoother {

// After the epoch's pose, if it has one. The gain is P Hᵀ N⁻¹ and computed again.
struct Record {
  Nominal x;
  std::vector<double> P;               // the upper triangle by columns: a long recording has many
  std::vector<Transition> transition;  // one, to the next epoch, or none where that would take too much memory
  bool updated = false;
  bool believed = false;  // the pose has its weight
  Predicted predicted;
  Matrix6d S_inverse;
  Matrix6d N_inverse;
  int refused_in_a_row = 0;

  Square covariance(int n) const;
  void keep(const Square& covariance);
};

struct Forward {
  std::vector<Record> records;  // per epoch; empty if only the likelihood was wanted
  Checkpoint last;
  double log_likelihood = 0.0;
};

Forward run_forward(const Problem& problem, bool keep, const Observer& observer);

}  // namespace asperity::inertial_smoother

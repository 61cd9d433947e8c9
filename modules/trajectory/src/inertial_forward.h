#pragma once

#include <vector>

#include "inertial_model.h"

// The filter: what it keeps of every epoch for the smoother to run back over.
namespace asperity::inertial_smoother {

// After the epoch's pose, if it has one. The gain is P Hᵀ N⁻¹ and computed again.
struct Record {
  Nominal x;
  std::vector<double> P;  // the upper triangle by columns
  Transition transition;  // to the next epoch; not set at the last, nor where a stretch begins at the next
  bool updated = false;
  bool believed = false;  // the pose has its weight
  Predicted predicted;
  Matrix6d S_inverse;
  Matrix6d N_inverse;
  int refused_in_a_row = 0;

  Square covariance(int n) const;
  void keep(const Square& covariance);
};

// The filter on its way over the epochs, one after another from the first.
class ForwardPass {
 public:
  explicit ForwardPass(const Problem& problem);

  // From the epoch before over the interval, and over the pose of the next epoch. Fills in `before`, the transition of
  // the record before, and `here`, the epoch's own record; nullptr: not kept.
  void step(Transition* before, Record* here);
  Checkpoint state() const { return {x_, P_, refused_in_a_row_}; }
  double log_likelihood() const { return log_likelihood_; }

 private:
  void carry(Transition* before);
  void correct(std::size_t pose, Record* here);

  const Problem* problem_;
  std::size_t epoch_ = 0;    // the next
  std::size_t restart_ = 0;  // likewise
  Nominal x_;
  Square P_;
  int refused_in_a_row_ = 0;
  double log_likelihood_ = 0.0;
};

// The records of all epochs, of which one block is in memory: an hour's would be gigabytes. Another block is filtered
// again from where the filter was at its begin: the same arithmetic, hence the same bytes.
class ForwardRecords {
 public:
  static constexpr std::size_t kBlockEpochs = 8192;  // 10 kB each

  // Filters all of `problem`, which outlives this object. Throws Cancelled.
  ForwardRecords(const Problem& problem, const Observer& observer, std::size_t block_epochs = kBlockEpochs);

  std::size_t size() const { return epochs_; }
  // Valid until another block is asked for; quick if epochs are asked for in order, either way. Throws Cancelled.
  const Record& at(std::size_t epoch);

 private:
  void fill(ForwardPass& pass, std::size_t block, const Observer& observer);

  Observer observer_;
  std::size_t epochs_ = 0;
  std::size_t block_epochs_;
  std::vector<ForwardPass> begins_;  // of the blocks
  std::size_t block_ = 0;            // in memory
  std::vector<Record> records_;
};

}  // namespace asperity::inertial_smoother

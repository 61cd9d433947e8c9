#pragma once

#include <cstdint>
#include <deque>

#include "asperity/profile/find_contact.h"

namespace asperity {

// The causal counterpart of find_contact.h: readings of the force come in order of time, and what was true at a time
// can be asked for once the readings are `delay_s` past it. Thread-safe: no.
class CausalContact {
 public:
  // Throws Error if release_N exceeds touch_N.
  explicit CausalContact(const ContactConfig& config);

  // A reading; nan and times that do not rise are passed over. Memory is bounded by forget_before().
  void push(std::int64_t t_ns, double force_N);

  // Whether the tip touched at t_ns; true throughout if there has never been a reading.
  bool touching_at(std::int64_t t_ns) const;

  double delay_s() const { return config_.smoothing_s + config_.max_flight_s + config_.margin_s; }
  bool measured() const { return measured_; }

  // Times before t_ns are not asked for any more.
  void forget_before(std::int64_t t_ns);
  // As if no reading had come.
  void reset();

 private:
  struct Reading {
    std::int64_t t_ns;
    double force_N;
  };
  struct Change {
    std::int64_t t_ns;
    bool touching;
  };
  void change(std::int64_t t_ns, bool touching);

  ContactConfig config_;
  std::deque<Reading> window_;  // over which the force is averaged
  std::deque<Change> changes_;  // of the result, margins and flights in it
  bool measured_ = false;
  bool touching_ = false;         // by the two thresholds
  std::int64_t lifted_ns_ = 0;    // of a loss of contact that may still be a flight
  bool flight_possible_ = false;  // likewise
};

}  // namespace asperity

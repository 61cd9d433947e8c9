#pragma once

#include <chrono>
#include <set>
#include <string>

#include "asperity/recorder/recorder_snapshot.h"

namespace asperity::app {

// What the recorder does, in one line: "12.3 s  segment_1 …".
std::string record_line(const RecorderSnapshot& now);

// Shows a recording under way on standard error: one line that is written over five times a second on a terminal,
// else a line every two seconds; and a line of its own for whatever happens to the sensors.
class RecordStatus {
 public:
  // `says_keys`: what the keys do is said once.
  RecordStatus(bool quiet, bool says_keys);
  ~RecordStatus();
  RecordStatus(const RecordStatus&) = delete;
  RecordStatus& operator=(const RecordStatus&) = delete;

  void show(const RecorderSnapshot& now);
  void clear();

 private:
  void print_line(const std::string& text);
  void print_changes(const char* what, const SensorSnapshot& now, SensorSnapshot& before);

  using Clock = std::chrono::steady_clock;
  bool quiet_;
  bool terminal_;
  bool visible_ = false;
  Clock::time_point next_ = Clock::now();
  SensorSnapshot probe_;
  SensorSnapshot poses_;
  ProbeFaults faults_;
  std::set<std::string> printed_;  // warnings, without their digits
};

}  // namespace asperity::app

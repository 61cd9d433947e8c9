#pragma once

#include <array>
#include <string_view>

#include "asperity/recorder/gravity_estimator.h"
#include "asperity/recorder/touch_config.h"

namespace asperity {

// kSegments: stored from start_segment() to stop_segment(). kAuto: stored while the probe touches (thesis §3.3).
enum class StoreMode { kSegments, kAuto };
inline constexpr std::array<std::string_view, 2> kStoreModeNames{"segments", "auto"};

struct RecorderConfig {
  StoreMode mode = StoreMode::kSegments;
  bool start_at_once = false;
  double pre_roll_s = 1.0;
  double post_roll_s = 0.5;
  TouchConfig contact;
  RestConfig rest;
  int probe_queue = 65'536;
  int pose_queue = 4'096;
  double flush_s = 0.05;
  double sync_s = 5.0;
  double stale_s = 1.0;
  double first_retry_s = 0.1;
  double longest_retry_s = 2.0;
  double describe_s = 3.0;

  template <class V>
  void visit(V& v) {
    v.choice("mode", mode, kStoreModeNames, "segments: from start to stop; auto: while the probe touches");
    v.field("start_at_once", start_at_once, "segments: begin the first one with the first row");
    v.field("pre_roll_s", pre_roll_s, "stored before a segment's start, s", {0.0, 10.0});
    v.field("post_roll_s", post_roll_s, "auto: stored after the touch, s", {0.0, 10.0});
    v.group("contact", contact);
    v.group("rest", rest);
    v.field("probe_queue", probe_queue, "samples that may wait for the disk", {16, 1'000'000});
    v.field("pose_queue", pose_queue, "poses that may wait for the disk", {16, 100'000});
    v.field("flush_s", flush_s, "how often rows are handed to the operating system, s", {0.005, 0.15});
    v.field("sync_s", sync_s, "how often they are forced to the disk, s; 0: at the end only", {0.0, 3600.0});
    v.field("stale_s", stale_s, "time without data after which a sensor is opened again, s", {0.1, 3600.0});
    v.field("first_retry_s", first_retry_s, "wait before a lost sensor is opened again, doubled each time, s",
            {0.01, 60.0});
    v.field("longest_retry_s", longest_retry_s, "and at most, s", {0.01, 600.0});
    v.field("describe_s", describe_s, "how long a probe may take to describe itself, s", {0.0, 60.0});
  }
};

}  // namespace asperity

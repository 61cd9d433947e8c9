#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "asperity/recorder/recorder.h"
#include "asperity/studio/hub.h"
#include "scan/live_scan_buffer.h"
#include "scan/row_tap.h"
#include "scan/scan_config.h"
#include "scan/scan_estimator.h"
#include "scan/scan_source.h"

namespace asperity::studio {

struct ScanSetup {
  std::unique_ptr<ScanSource> source;
  ScanConfig config;
  bool automatic = false;
  std::filesystem::path folder;  // new
  std::string name;              // of the folder in the project
  std::string object;
  std::string created;  // ISO 8601
};

// The causal profile of a scan.
struct LiveHeights {
  std::vector<double> s_m, height_m;
};

// A stroke that has finished, as the recording has it.
struct FinishedScan {
  std::string recording;  // name of the folder in the project
  Segment segment;
  Recording rows;  // of the segment alone
  LiveHeights live;
};

// The events of a session, in its own thread.
struct ScanEvents {
  std::function<void(FinishedScan)> finished;
  std::function<void(LiveHeights)> retuned;  // the finished scan's causal profile, with other settings
  std::function<void()> discarded;           // it may be brought back: finished() again, with the same times
  std::function<void()> forgotten;           // another has replaced it
  std::function<void(std::string)> lost;     // why the recording could not be finished, where nobody called finish()
};

// An open source with its recorder, and a thread that shows what comes from it: topics scan.probe, scan.state,
// scan.pose, scan.profile and scan.image. Opening takes as long as the sensors need. Functions are for one thread at a
// time, the studio's; none of them waits but finish().
class ScanSession {
 public:
  // Throws Error if a sensor cannot be opened.
  ScanSession(Hub& hub, ScanSetup setup, ScanEvents events);
  // As finish().
  ~ScanSession();
  ScanSession(const ScanSession&) = delete;
  ScanSession& operator=(const ScanSession&) = delete;

  void start(const std::string& name);
  void stop();
  // Ends the open segment and begins the next one, called `name` unless that is empty.
  void next_segment(const std::string& name);
  void discard();
  void rescan();
  // Brings back what was discarded last. Throws Advice if there is nothing.
  void restore();
  void set_automatic(bool automatic);
  // New settings of the live estimate and of the hints; the scan so far is computed again with them.
  void tune(const ScanConfig& config);

  const std::string& name() const { return setup_.name; }
  Json description() const;
  RecorderSnapshot snapshot() const { return recorder_->snapshot(); }
  BlockWriter profile() const;
  BlockWriter path() const;

  // Closes the sensors and makes the recording final; one that holds nothing is taken away again, and false. Throws
  // Error if it could not be written.
  bool finish();

 private:
  struct Watched {
    bool storing = false;
    std::size_t begun = 0;  // segments, also those that were discarded
    std::size_t discarded = 0, restored = 0;
    std::optional<Segment> last_discarded;
  };

  // Data of the probe and its position, in addition to those of the source.
  struct Known {
    bool description = false, gravity = false;
    bool operator==(const Known&) const = default;
  };

  // A segment that waits for the poses of its end.
  struct FinishedSegment {
    Segment segment;
    std::optional<LiveHeights> live;  // nullopt: the book has them
    std::int64_t hand_over_at_ns = 0;
  };

  // What was discarded last, as it was shown.
  struct DiscardedSegment {
    Segment segment;
    LiveScanBuffer book;
  };

  void begin_in_contact();
  RecordingInfo info_of(const RecorderSnapshot& now) const;
  void run();
  void take_rows(bool storing);
  void watch(const RecorderSnapshot& now);
  bool use_what_is_known(const RecorderSnapshot& now);
  void begin_scan(const RecorderSnapshot& now);
  void keep_finished(FinishedSegment finished, const RecorderSnapshot& now);
  void keep_discarded(const RecorderSnapshot& now);
  void bring_back(const Segment& segment, const RecorderSnapshot& now);
  void grow_again(const RecorderSnapshot& now);
  void hand_over(const RecorderSnapshot& now);
  void retune(const RecorderSnapshot& now);
  LiveHeights live_heights() const;
  void run_round(bool last);
  void send_message(const std::string& message, const std::string& hint);
  BlockWriter state_of(const RecorderSnapshot& now, std::int64_t now_ns);
  void show_rows();
  void show(const RecorderSnapshot& now, std::int64_t now_ns);
  void publish(std::string_view topic, BlockWriter block, Delivery delivery);

  Hub& hub_;
  ScanSetup setup_;
  ScanEvents events_;
  std::int64_t origin_ns_;
  Calibration calibration_;  // or a stand-in
  RowTap tap_;
  std::unique_ptr<Recorder> recorder_;
  bool automatic_ = false;

  // The session's thread alone.
  RowTap::TakenRows taken_;
  std::optional<ScanEstimator> estimator_;
  ScanConfig config_;
  Known used_;  // what the estimator has
  Watched before_;
  bool was_playing_ = false;
  std::optional<Segment> shown_;  // the scan that the book is about
  std::optional<FinishedSegment> finished_;
  std::optional<DiscardedSegment> discarded_;
  std::int64_t newest_row_ns_ = 0;
  double age_s_ = 0.0;
  std::uint64_t poses_late_ = 0;
  std::string sent_message_;  // the last fault that was sent
  std::int64_t stated_ns_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  LiveScanBuffer book_;
  std::optional<ScanConfig> wanted_;  // settings to be taken
  bool end_ = false;
  std::thread thread_;
};

}  // namespace asperity::studio

#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "asperity/recording/recording.h"

namespace asperity {

// Does in a thread of its own what may wait for the disk while rows are written: replaces recording.json, and forces
// the files, those of `bodies` too, to the disk every `sync_s`.
class RecordingInfoWriter {
 public:
  RecordingInfoWriter(std::filesystem::path folder, const std::vector<TrackedBody>& bodies, double sync_s);  // 0: never
  // Ends; an info that is not yet written is left.
  ~RecordingInfoWriter();
  RecordingInfoWriter(const RecordingInfoWriter&) = delete;
  RecordingInfoWriter& operator=(const RecordingInfoWriter&) = delete;

  // To be written soon; a newer one takes its place.
  void put(const RecordingInfo& info);

  // The first thing that the disk refused, in words; empty: nothing.
  std::string failure() const;

 private:
  void run();
  // Throws Error for the first file that the disk refuses.
  void sync() const;

  std::filesystem::path folder_;
  std::vector<std::string> files_;
  double sync_s_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::optional<RecordingInfo> waiting_;
  std::string failure_;
  std::thread thread_;
};

}  // namespace asperity

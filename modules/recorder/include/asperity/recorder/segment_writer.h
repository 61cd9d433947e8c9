#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "asperity/recording/recording_appender.h"

namespace asperity {

// Decides which rows of the streams (the probe's, its poses, those of further bodies) go to disk: those within
// segments. Rows that no segment has claimed yet wait in rings for a segment that begins in the past. Works on the
// rows' own times; no clock, no thread.
class SegmentWriter {
 public:
  // `keep_ns`: how far back a segment may begin. The appender must live longer.
  SegmentWriter(RecordingAppender& appender, std::int64_t keep_ns);

  // Rows of a stream in order of time; one that does not rise is dropped and counted. The rings hold a second more
  // than `keep_ns`, for the stream that comes late.
  void add(const ProbeSample& sample);
  void add(const TrackerSample& sample);

  // Begins a segment `pre_roll_ns` before `t_ns`, earlier rows from the rings included; not before the first row, nor
  // before the end of what was discarded. kFromFirstRow: where the first row will be. False if one is open, or there
  // are too many.
  bool start(std::string name, std::int64_t t_ns, std::int64_t pre_roll_ns);
  // The open segment ends at `t_ns`, which may lie ahead; reopen() takes that back while it does.
  void end_at(std::int64_t t_ns);
  bool reopen();
  // Closes the open segment if rows have come to its end; the other stream's that come later are taken still. True if
  // it did.
  bool settle() { return settle(latest_ns_); }
  // The same where time is known to have come to `t_ns` without rows.
  bool settle(std::int64_t t_ns);
  // Closes it at `t_ns`, or where it was to end before.
  void close(std::int64_t t_ns);
  // Takes the open segment out of the list, or else the last one, and gives its name; nullopt if there is none.
  // Its rows stay in the files until RecordingAppender::finish.
  std::optional<std::string> discard(std::int64_t t_ns);
  // Restores the segment that was discarded last, closed, and gives its name, which is another one if there is one
  // of that name by now; nullopt if nothing is there to be brought back.
  std::optional<std::string> restore();

  bool is_open() const { return open_; }
  bool is_ending() const { return open_ && segments_.back().end_ns != kNoEnd; }
  // The open one, too, which then ends at the latest row; without one it is not yet there.
  std::vector<Segment> segments() const;
  std::size_t count() const { return segments_.size(); }
  std::string last_name() const { return segments_.empty() ? "" : segments_.back().name; }
  // Less those that were brought back.
  std::size_t discarded() const { return discarded_; }
  std::size_t restored() const { return restored_; }
  // What can be brought back, the one discarded last at the end. Of more than kMostDiscarded the oldest are given up.
  const std::vector<Segment>& discarded_rows() const { return discarded_rows_; }
  // The latest end of what is discarded; nullopt: nothing is.
  std::optional<std::int64_t> discarded_until_ns() const;
  std::uint64_t probe_rows() const { return probe_.written; }
  std::uint64_t tracker_rows() const { return tracker_.written; }
  // Of the further body `body`, from 1.
  std::uint64_t body_rows(std::size_t body) const { return body <= bodies_.size() ? bodies_[body - 1].written : 0; }
  std::uint64_t late_rows() const;
  // Seconds within segments so far.
  double recorded_s() const;
  // The latest time that a row of either stream has had.
  std::int64_t latest_ns() const { return latest_ns_; }

  static constexpr std::int64_t kFromFirstRow = std::numeric_limits<std::int64_t>::min() / 4;
  static constexpr std::int64_t kNoEnd = std::numeric_limits<std::int64_t>::max();
  static constexpr std::size_t kMostSegments = 10'000;
  static constexpr std::size_t kMostDiscarded = 100;

 private:
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();

  template <class Sample>
  struct Stream {
    std::deque<Sample> ring;
    std::int64_t last_ns = kNever;
    std::uint64_t written = 0;
    std::uint64_t late = 0;
  };

  template <class Sample>
  void take(Stream<Sample>& stream, const Sample& sample);
  template <class Sample>
  void write(Stream<Sample>& stream, const Sample& sample);
  template <class Sample>
  void claim(Stream<Sample>& stream, std::int64_t start_ns);
  void claim_all(std::int64_t start_ns);
  bool is_claimed(std::int64_t t_ns) const;
  std::string free_name(const std::string& name) const;

  RecordingAppender& appender_;
  std::int64_t keep_ns_;
  Stream<ProbeSample> probe_;
  Stream<TrackerSample> tracker_;
  std::vector<Stream<TrackerSample>> bodies_;  // as they come
  std::vector<Segment> segments_;
  bool open_ = false;  // the last one
  std::vector<Segment> discarded_rows_;
  std::size_t discarded_ = 0;
  std::size_t restored_ = 0;
  std::int64_t given_up_until_ns_ = kNever;  // the latest end of what cannot be brought back any more
  std::int64_t first_ns_ = kNoEnd;
  std::int64_t latest_ns_ = kNever;
};

}  // namespace asperity

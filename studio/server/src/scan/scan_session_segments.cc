#include <algorithm>
#include <utility>

#include "asperity/base/host_clock.h"
#include "scan/scan_session.h"

namespace asperity::studio {

namespace {

constexpr std::int64_t kPosesLate_ns = 250'000'000;  // behind the rows of their time, at most

}  // namespace

// What has become of the segments since the last round.
void ScanSession::watch(const RecorderSnapshot& now) {
  const auto& list = now.segment_list;
  const Watched before = std::exchange(
      before_, {now.storing, now.segments + now.discarded, now.discarded, now.restored, now.last_discarded});
  const bool restored = now.restored > before.restored;
  const bool discarded = now.discarded + now.restored > before.discarded + before.restored;
  if (discarded) {
    estimator_->kept().hold(true);  // it may be needed again
    // After a restored one is shown, the recording's last may be another.
    const bool is_another = shown_ && now.last_discarded && shown_->start_ns != now.last_discarded->start_ns;
    if (!is_another) {
      keep_discarded(now);
      events_.discarded();
    }
  }
  // One may have finished and the next begun between two rounds.
  const std::size_t next = before.storing && !discarded ? before_.begun - std::min(before_.begun, before.begun) : 0;
  if (next > 0 && next < list.size()) keep_finished({list[list.size() - 1 - next], live_heights(), 0}, now);
  if (next > 0 || (now.storing && (!before.storing || discarded))) begin_scan(now);
  if ((now.storing || (before.storing && !discarded)) && !list.empty()) shown_ = list.back();
  if (!now.storing && before.storing && !discarded && !list.empty()) {
    keep_finished({list.back(), std::nullopt, 0}, now);
    events_.forgotten();  // what is refined is another's
  }
  if (restored && before.last_discarded && !now.storing) bring_back(*before.last_discarded, now);
  // A source that has played to its end has nothing more for the segment that is open.
  if (setup_.source->plays() && now.storing && was_playing_ && !setup_.source->playing()) {
    if (now.automatic) recorder_->set_mode(StoreMode::kSegments);
    recorder_->stop_segment();
    if (now.automatic) recorder_->set_mode(StoreMode::kAuto);
  }
  was_playing_ = setup_.source->playing();
  // While rows are stored gravity waits: the estimate would start again in the middle.
  if (now.storing && (!now.description || used_.description)) return;
  if (use_what_is_known(now) && now.storing && shown_ && estimator_->kept().covers(shown_->start_ns)) grow_again(now);
}

// True if the probe has described itself, or gravity was measured, since the estimator was last updated: it starts
// again.
bool ScanSession::use_what_is_known(const RecorderSnapshot& now) {
  const Known known{now.description.has_value(), now.gravity.measured};
  if (known == used_) return false;
  estimator_->configure(info_of(now), config_);
  used_ = known;
  return true;
}

void ScanSession::begin_scan(const RecorderSnapshot& now) {
  use_what_is_known(now);
  estimator_->restart();
  KeptRows& kept = estimator_->kept();
  if (!now.segment_list.empty()) {
    const std::int64_t trail_ns = now.segment_list.back().start_ns - KeptRows::kTrail_ns;
    std::int64_t wanted_ns = trail_ns;
    if (finished_) wanted_ns = std::min(wanted_ns, finished_->segment.start_ns);
    if (discarded_) wanted_ns = std::min(wanted_ns, discarded_->segment.start_ns);
    kept.forget_before(wanted_ns);
  }
  kept.hold(true);
  events_.forgotten();
  if (finished_ && !finished_->live) finished_->live = live_heights();
  const std::lock_guard lock(mutex_);
  book_.restart();
}

void ScanSession::keep_finished(FinishedSegment finished, const RecorderSnapshot& now) {
  if (finished_) hand_over(now);
  finished_ = std::move(finished);
  finished_->hand_over_at_ns = host_now_ns() + kPosesLate_ns;
}

void ScanSession::keep_discarded(const RecorderSnapshot& now) {
  const std::optional<Segment> shown = std::exchange(shown_, std::nullopt);
  finished_.reset();
  const std::lock_guard lock(mutex_);
  LiveScanBuffer book = book_.restart();
  const bool is_shown = shown && now.last_discarded && shown->start_ns == now.last_discarded->start_ns;
  if (is_shown) discarded_ = DiscardedSegment{*now.last_discarded, std::move(book)};
}

// What was discarded is shown again, as if it had just finished.
void ScanSession::bring_back(const Segment& segment, const RecorderSnapshot& now) {
  const auto& list = now.segment_list;
  const auto back = std::find_if(list.begin(), list.end(), [&](const Segment& each) {
    return each.start_ns == segment.start_ns && each.end_ns == segment.end_ns;
  });
  if (back == list.end()) return;
  if (!estimator_->kept().covers(back->start_ns)) {
    send_message(back->name + " is in the recording again, but its rows are no longer in memory",
                 "Finish the recording, and open it on the Process page.");
    return;
  }
  events_.forgotten();
  shown_ = *back;
  if (discarded_ && discarded_->segment.start_ns == back->start_ns) {
    DiscardedSegment discarded = *std::exchange(discarded_, std::nullopt);
    const std::lock_guard lock(mutex_);
    book_.begin_with(std::move(discarded.book));
  } else {
    grow_again(now);
  }
  finished_ = FinishedSegment{*back, std::nullopt, host_now_ns()};
}

void ScanSession::hand_over(const RecorderSnapshot& now) {
  const auto [segment, live, due_ns] = *std::exchange(finished_, std::nullopt);
  KeptRows& kept = estimator_->kept();
  kept.hold(true);  // until the next scan begins: it may be discarded, and be needed again
  if (!kept.covers(segment.start_ns)) {
    send_message(segment.name + " is too long to be refined here; the recording is complete",
                 "Finish the recording, and open it on the Process page.");
    return;
  }
  FinishedScan out;
  out.recording = setup_.name;
  out.segment = segment;
  out.rows.info = info_of(now);
  out.rows.info.segments = {segment};
  out.rows.calibration = calibration_;
  kept.copy(segment.start_ns, segment.end_ns, now.description && now.description->has_gyro, out.rows);
  const TrackerStream& poses = out.rows.tracker;
  if (out.rows.info.tracker_rate_Hz <= 0.0 && poses.size() > 1) {
    const auto span_ns = static_cast<double>(poses.t_ns.back() - poses.t_ns.front());
    out.rows.info.tracker_rate_Hz = 1e9 * static_cast<double>(poses.size() - 1) / span_ns;
  }
  out.live = live ? *live : live_heights();
  events_.finished(std::move(out));
}

}  // namespace asperity::studio

#include "scan/scan_session.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <system_error>
#include <utility>

#include "asperity/acquire/host_clock.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/recording/uncalibrated.h"
#include "asperity/studio/calls.h"
#include "scan/scan_blocks.h"

namespace asperity::studio {

namespace {

constexpr auto kRound = std::chrono::milliseconds(15);
constexpr std::int64_t kPosesLate_ns = 250'000'000;  // behind the rows of their time, at most

}  // namespace

ScanSession::ScanSession(Hub& hub, ScanSetup setup, ScanEvents events)
    : hub_(hub),
      setup_(std::move(setup)),
      events_(std::move(events)),
      origin_ns_(host_now_ns()),
      calibration_(setup_.source->calibration().value_or(make_uncalibrated(0.0, 0.0, 0.0))),
      config_(setup_.config) {
  RecorderConfig recorder = config_.recorder;
  recorder.mode = setup_.automatic ? StoreMode::kAuto : StoreMode::kSegments;
  recorder.start_at_once = false;
  setup_.source->adapt(recorder);
  RecordingInfo info = setup_.source->info();
  info.created = setup_.created;
  if (!setup_.object.empty()) info.object = setup_.object;
  const auto on_frame = [this](const CameraFrame& frame) { tap_.add(frame); };
  recorder_ = std::make_unique<Recorder>(setup_.folder, info, setup_.source->calibration(),
                                         with_tap(setup_.source->sensors(config_.track, on_frame), tap_), recorder);
  try {
    const RecorderSnapshot now = recorder_->snapshot();
    estimator_.emplace(calibration_, setup_.source->calibration().has_value(), info_of(now), config_);
    used_ = {now.description.has_value(), now.gravity.measured};
    thread_ = std::thread([this] { run(); });
  } catch (...) {
    recorder_.reset();
    std::error_code ignored;
    std::filesystem::remove_all(setup_.folder, ignored);
    throw;
  }
}

ScanSession::~ScanSession() {
  try {
    finish();
  } catch (const Error&) {
    // The rows so far remain readable.
  }
}

void ScanSession::start(const std::string& name) {
  if (setup_.source->plays()) setup_.source->play();
  recorder_->start_segment(name);
  begin_in_contact();
}

void ScanSession::stop() {
  recorder_->stop_segment();
  if (setup_.source->plays()) setup_.source->stop_playing();
}

void ScanSession::next_segment(const std::string& name) {
  recorder_->stop_segment();
  start(name);
}

void ScanSession::discard() {
  recorder_->discard_segment();
  if (setup_.source->plays()) setup_.source->stop_playing();
}

void ScanSession::rescan() {
  if (setup_.source->plays()) setup_.source->play();
  recorder_->rescan_segment();
  begin_in_contact();
}

void ScanSession::restore() {
  if (!snapshot().last_discarded)
    throw Advice("nothing was discarded that could be brought back",
                 "Segments can be brought back until the recording is closed.");
  recorder_->restore_segment();
}

// What plays may have ended in contact, and begins so: no touch then begins the segment.
void ScanSession::begin_in_contact() {
  if (setup_.source->plays() && automatic_) recorder_->set_mode(StoreMode::kAuto);
}

void ScanSession::set_automatic(bool automatic) {
  automatic_ = automatic;
  recorder_->set_mode(automatic ? StoreMode::kAuto : StoreMode::kSegments);
}

void ScanSession::tune(const ScanConfig& config) {
  const std::lock_guard lock(mutex_);
  wanted_ = config;
}

Json ScanSession::description() const {
  Json out;
  out["name"] = setup_.name;
  out["object"] = setup_.object;
  out["plays"] = setup_.source->plays();
  out["playing"] = setup_.source->playing();
  out["calibrated"] = setup_.source->calibration().has_value();
  out["tip_in_marker_m"] = {calibration_.tip_in_marker_m.x(), calibration_.tip_in_marker_m.y(),
                            calibration_.tip_in_marker_m.z()};
  if (calibration_.camera) out["camera"] = camera_json(*calibration_.camera);
  return out;
}

BlockWriter ScanSession::profile() const {
  const std::lock_guard lock(mutex_);
  return book_.profile();
}

BlockWriter ScanSession::path() const {
  const std::lock_guard lock(mutex_);
  return book_.path();
}

bool ScanSession::finish() {
  if (!recorder_) return true;
  setup_.source->stop_playing();
  // The recorder ends first: the last round of the session's thread sees all that there was.
  std::exception_ptr failure;
  std::size_t segments = 0;
  try {
    segments = recorder_->finish().segments;
  } catch (const Error&) {
    failure = std::current_exception();
  }
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  recorder_.reset();
  setup_.source.reset();
  if (failure) std::rethrow_exception(failure);
  if (segments > 0) return true;
  std::error_code ignored;
  std::filesystem::remove_all(setup_.folder, ignored);
  return false;
}

RecordingInfo ScanSession::info_of(const RecorderSnapshot& now) const {
  RecordingInfo out = setup_.source->info();
  if (!setup_.object.empty()) out.object = setup_.object;
  if (now.description) {
    out.probe_model = printable(now.description->model);
    out.probe_rate_Hz = now.description->rate_Hz;
    out.adc_min = now.description->adc_min;
    out.adc_max = now.description->adc_max;
  }
  if (now.gravity.measured) out.gravity_world_mps2 = now.gravity.gravity_world_mps2;
  return out;
}

void ScanSession::run() {
  for (bool last = false; !last;) {
    {
      std::unique_lock lock(mutex_);
      last = changed_.wait_for(lock, kRound, [this] { return end_; });
    }
    try {
      round(last);
    } catch (const std::exception& error) {
      tell(std::string("The live profile stops here: ") + error.what(),
           "The recording goes on. Take the last change of the settings back, or stop and process the recording.");
    }
  }
}

void ScanSession::round(bool last) {
  const RecorderSnapshot now = recorder_->snapshot();
  tap_.want_images(hub_.has_subscribers("scan.image"));
  tap_.take(taken_);
  show_rows();  // first: the estimate takes its time on a busy machine
  watch(now);
  retune(now);
  take_rows(now.storing);
  show(now, host_now_ns());
  if (ended_ && (last || host_now_ns() >= ended_->hand_over_at_ns)) hand_over(now);
}

// A fault that comes again each round is told once.
void ScanSession::tell(const std::string& message, const std::string& hint) {
  if (message == told_) return;
  told_ = message;
  hub_.broadcast("note", Json{{"message", message}, {"hint", hint}});
}

void ScanSession::take_rows(bool storing) {
  if (!taken_.rows.empty()) newest_row_ns_ = taken_.rows.back().t_ns;
  const LiveEstimate estimate = estimator_->take(taken_.rows, taken_.poses);
  age_s_ = estimate.age_s;
  poses_late_ = estimate.counts.poses_late;
  const std::lock_guard lock(mutex_);
  book_.add(estimate, storing);
}

// What has become of the segments since the last round.
void ScanSession::watch(const RecorderSnapshot& now) {
  const auto& list = now.segment_list;
  const Watched before = std::exchange(
      before_, {now.storing, now.segments + now.discarded, now.discarded, now.restored, now.last_discarded});
  const bool restored = now.restored > before.restored;
  const bool discarded = now.discarded + now.restored > before.discarded + before.restored;
  if (discarded) {
    estimator_->kept().hold(true);  // it may be wanted again
    // After a restored one is shown, the recording's last may be another.
    const bool is_another = shown_ && now.last_discarded && shown_->start_ns != now.last_discarded->start_ns;
    if (!is_another) {
      shelve(now);
      events_.discarded();
    }
  }
  // One may have ended and the next begun between two rounds.
  const std::size_t next = before.storing && !discarded ? before_.begun - std::min(before_.begun, before.begun) : 0;
  if (next > 0 && next < list.size()) keep_ended({list[list.size() - 1 - next], live_heights(), 0}, now);
  if (next > 0 || (now.storing && (!before.storing || discarded))) begin_scan(now);
  if ((now.storing || (before.storing && !discarded)) && !list.empty()) shown_ = list.back();
  if (!now.storing && before.storing && !discarded && !list.empty()) {
    keep_ended({list.back(), std::nullopt, 0}, now);
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
  // While rows are stored gravity waits: the estimate would begin anew in the middle.
  if (now.storing && (!now.description || used_.description)) return;
  if (use_what_is_known(now) && now.storing && shown_ && estimator_->kept().covers(shown_->start_ns)) grow_again(now);
}

// True if the probe has described itself, or gravity was measured, since the estimator was told last: it begins anew.
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
    if (ended_) wanted_ns = std::min(wanted_ns, ended_->segment.start_ns);
    if (shelved_) wanted_ns = std::min(wanted_ns, shelved_->segment.start_ns);
    kept.forget_before(wanted_ns);
  }
  kept.hold(true);
  events_.forgotten();
  if (ended_ && !ended_->live) ended_->live = live_heights();
  const std::lock_guard lock(mutex_);
  book_.begin_anew();
}

void ScanSession::keep_ended(Ended ended, const RecorderSnapshot& now) {
  if (ended_) hand_over(now);
  ended_ = std::move(ended);
  ended_->hand_over_at_ns = host_now_ns() + kPosesLate_ns;
}

void ScanSession::shelve(const RecorderSnapshot& now) {
  const std::optional<Segment> shown = std::exchange(shown_, std::nullopt);
  ended_.reset();
  const std::lock_guard lock(mutex_);
  ScanBook book = book_.begin_anew();
  const bool is_shown = shown && now.last_discarded && shown->start_ns == now.last_discarded->start_ns;
  if (is_shown) shelved_ = Shelved{*now.last_discarded, std::move(book)};
}

// What was discarded is shown again, as if it had just ended.
void ScanSession::bring_back(const Segment& segment, const RecorderSnapshot& now) {
  const auto& list = now.segment_list;
  const auto back = std::find_if(list.begin(), list.end(), [&](const Segment& each) {
    return each.start_ns == segment.start_ns && each.end_ns == segment.end_ns;
  });
  if (back == list.end()) return;
  if (!estimator_->kept().covers(back->start_ns)) {
    tell(back->name + " is in the recording again; its rows are not in memory any more",
         "Finish the recording, and open it on the Process page.");
    return;
  }
  events_.forgotten();
  shown_ = *back;
  if (shelved_ && shelved_->segment.start_ns == back->start_ns) {
    Shelved shelved = *std::exchange(shelved_, std::nullopt);
    const std::lock_guard lock(mutex_);
    book_.begin_with(std::move(shelved.book));
  } else {
    grow_again(now);
  }
  ended_ = Ended{*back, std::nullopt, host_now_ns()};
}

void ScanSession::hand_over(const RecorderSnapshot& now) {
  const auto [segment, live, due_ns] = *std::exchange(ended_, std::nullopt);
  KeptRows& kept = estimator_->kept();
  kept.hold(true);  // until the next scan begins: it may be discarded, and be wanted again
  if (!kept.covers(segment.start_ns)) {
    tell(segment.name + " is too long to be refined here; the recording has all of it",
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
  events_.ended(std::move(out));
}

LiveHeights ScanSession::live_heights() const {
  const std::lock_guard lock(mutex_);
  return {{book_.s_m().begin(), book_.s_m().end()}, {book_.height_m().begin(), book_.height_m().end()}};
}

// With new settings the scan that is shown grows anew at once from the rows that were kept.
void ScanSession::retune(const RecorderSnapshot& now) {
  std::optional<ScanConfig> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = std::exchange(wanted_, std::nullopt);
  }
  if (!wanted) return;
  estimator_->configure(info_of(now), *wanted);
  config_ = *wanted;
  shelved_.reset();  // of other settings
  told_.clear();
  if (!shown_ || !estimator_->kept().covers(shown_->start_ns)) return;
  grow_again(now);
  if (!now.storing) events_.retuned(live_heights());
}

void ScanSession::grow_again(const RecorderSnapshot& now) {
  const std::int64_t end_ns = now.storing ? std::numeric_limits<std::int64_t>::max() : shown_->end_ns;
  const LiveEstimate estimate = estimator_->again(shown_->start_ns, end_ns, now.storing);
  const std::lock_guard lock(mutex_);
  book_.begin_anew();
  book_.add(estimate, true);
}

}  // namespace asperity::studio

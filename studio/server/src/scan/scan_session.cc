#include "scan/scan_session.h"

#include <chrono>
#include <exception>
#include <limits>
#include <system_error>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/recording/uncalibrated.h"
#include "asperity/studio/calls.h"
#include "scan/scan_blocks.h"

namespace asperity::studio {

namespace {

constexpr auto kRound = std::chrono::milliseconds(15);

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
  } catch (const std::exception& fault) {
    if (events_.lost) events_.lost(fault.what());  // the rows so far remain readable
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
    throw Advice("no discarded segment can be restored", "Segments can be restored until the recording is closed.");
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
  } catch (const std::exception&) {
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
      run_round(last);
    } catch (const std::exception& error) {
      send_message(std::string("The live profile stops here: ") + error.what(),
                   "The recording continues. Undo the last change of the settings, or stop and process the recording.");
    }
  }
}

void ScanSession::run_round(bool last) {
  const RecorderSnapshot now = recorder_->snapshot();
  tap_.want_images(hub_.has_subscribers("scan.image"));
  tap_.take(taken_);
  show_rows();  // first: the estimate takes its time on a busy machine
  watch(now);
  retune(now);
  take_rows(now.storing);
  show(now, host_now_ns());
  if (finished_ && (last || host_now_ns() >= finished_->hand_over_at_ns)) hand_over(now);
}

// A fault that repeats each round is sent once.
void ScanSession::send_message(const std::string& message, const std::string& hint) {
  if (message == sent_message_) return;
  sent_message_ = message;
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

LiveHeights ScanSession::live_heights() const {
  const std::lock_guard lock(mutex_);
  return {{book_.s_m().begin(), book_.s_m().end()}, {book_.height_m().begin(), book_.height_m().end()}};
}

// With new settings the scan that is shown grows again at once from the rows that were kept.
void ScanSession::retune(const RecorderSnapshot& now) {
  std::optional<ScanConfig> wanted;
  {
    const std::lock_guard lock(mutex_);
    wanted = std::exchange(wanted_, std::nullopt);
  }
  if (!wanted) return;
  estimator_->configure(info_of(now), *wanted);
  config_ = *wanted;
  discarded_.reset();  // of other settings
  sent_message_.clear();
  if (!shown_ || !estimator_->kept().covers(shown_->start_ns)) return;
  grow_again(now);
  if (!now.storing) events_.retuned(live_heights());
}

void ScanSession::grow_again(const RecorderSnapshot& now) {
  const std::int64_t end_ns = now.storing ? std::numeric_limits<std::int64_t>::max() : shown_->end_ns;
  const LiveEstimate estimate = estimator_->again(shown_->start_ns, end_ns, now.storing);
  const std::lock_guard lock(mutex_);
  book_.restart();
  book_.add(estimate, true);
}

}  // namespace asperity::studio

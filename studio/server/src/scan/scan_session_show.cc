#include <cmath>
#include <utility>

#include "scan/scan_blocks.h"
#include "scan/scan_session.h"

namespace asperity::studio {

namespace {

constexpr std::int64_t kStatePeriod_ns = 80'000'000;

}  // namespace

void ScanSession::publish(std::string_view topic, BlockWriter block, Delivery delivery) {
  block.head()["topic"] = topic;
  hub_.publish(topic, block.take(), delivery);
}

void ScanSession::show_rows() {
  if (!taken_.rows.empty() && hub_.has_subscribers("scan.probe")) {
    publish("scan.probe",
            probe_block(taken_.rows, taken_.first_row, taken_.rows_dropped, origin_ns_, setup_.source->calibration()),
            Delivery::kSeries);
  }
  if (taken_.image) publish("scan.image", image_block(*taken_.image), Delivery::kLatest);
}

void ScanSession::show(const RecorderSnapshot& now, std::int64_t now_ns) {
  {
    const std::lock_guard lock(mutex_);
    if (book_.grown() && hub_.has_subscribers("scan.profile"))
      publish("scan.profile", book_.take_growth(), Delivery::kSeries);
    if (book_.moved() && hub_.has_subscribers("scan.pose"))
      publish("scan.pose", book_.take_motion(), Delivery::kSeries);
  }
  if (now_ns - stated_ns_ < kStatePeriod_ns) return;
  stated_ns_ = now_ns;
  publish("scan.state", state_of(now, now_ns), Delivery::kLatest);
}

BlockWriter ScanSession::state_of(const RecorderSnapshot& now, std::int64_t now_ns) {
  BlockWriter state("scan.state");
  Json& head = state.head();
  head["open"] = true;
  head["t_ns"] = now_ns;
  head["source"] = description();
  head["recorder"] = recorder_json(now);
  head["live"] = {{"waiting", estimator_->waiting()},
                  {"age_s", age_s_},
                  {"poses_late", poses_late_},
                  {"highest_speed_mps", Json()}};
  const double fastest_mps = estimator_->highest_speed_mps();
  if (std::isfinite(fastest_mps)) head["live"]["highest_speed_mps"] = fastest_mps;
  // A source that waits for its start is silent for no fault.
  head["hints"] = setup_.source->playing() ? hints_json(estimator_->hints(now_ns)) : Json::array();
  return state;
}

}  // namespace asperity::studio

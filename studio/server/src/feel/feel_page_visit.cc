#include <utility>

#include "asperity/base/host_clock.h"
#include "feel/feel_page.h"

// What is rendered for another page.

namespace asperity::studio {

void FeelPage::change_visit(FeelVisit visit) {
  if (!run_ || !visited_ || state_ != State::kRunning) return;
  visit_key_ = 0;
  permit(host_now_ns());
  run_->watch(nullptr);
  auto result = std::make_shared<PreparedModel>();
  shared_.jobs.start(
      "", "feel.visit",
      [result, visit, info = running_.info, kind = running_.kind, servo = running_.config.feel.servo](const Observer&) {
        FeelSetup setup = visit.setup;
        const Scene scene = visit.make(setup);
        // Position, rate and safety of the device are fixed for the run.
        setup.config.feel.servo = servo;
        *result = prepare_render_model(scene, info, kind.driven() || kind.name == "mouse", setup.config.feel);
      },
      [this, result, touches = visit.touches, key = visit.key, number = run_number_,
       change = ++visit_changes_](std::exception_ptr error) {
        if (!run_ || number != run_number_ || change != visit_changes_) return;
        if (error) {
          complain(error);
          return leave();
        }
        run_->swap(std::move(result->model));
        run_->watch(touches);
        visit_key_ = key;
        held_until_ns_ = host_now_ns() + kHold_ns;
        send_status();
      });
  send_status();
}

void FeelPage::leave() {
  if (visited_) end_run();
}

bool FeelPage::is_leaving() const {
  return visited_ && (state_ == State::kStopping || (state_ == State::kOpening && stop_asked_));
}

std::uint64_t FeelPage::visited_key() const {
  return visited_ && permitted_ && state_ == State::kRunning && held_until_ns_ == 0 ? visit_key_ : 0;
}

}  // namespace asperity::studio

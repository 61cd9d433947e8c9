#include "feel/feel_page.h"

#include <array>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/device/write_flight_record.h"
#include "asperity/session/our_file.h"
#include "asperity/verdict/verdict_json.h"
#include "feel/feel_run.h"
#include "feel/finished_logs.h"

// The run's side of the page: its start and end, whose it is, its log.

namespace asperity::studio {

namespace {

constexpr std::array<const char*, 4> kEnds{"time limit reached", "end of the path", "stopped", "fault"};

// How a run went: its end, statistics, verdicts, and how well the schedule of `servo` was kept.
Json outcome_json(const FeelOutcome& outcome, const ServoConfig& servo) {
  Json out;
  out["end"] = kEnds.at(static_cast<std::size_t>(outcome.servo.end));
  out["verdicts"] = verdicts_json(outcome.verdicts);
  out["duration_s"] = static_cast<double>(outcome.statistics.ticks()) / servo.rate_Hz;
  out["figures"] = outcome.statistics.json();
  out["timing"] = timing_json(outcome.servo.statistics, servo);
  out["text"] = outcome.statistics.text();
  return out;
}

constexpr const char* kFlightRecord = "asperity-feel.flight.csv";

std::string lost_log(const std::string& name) { return "the log " + printable(name, 200) + " is lost"; }

}  // namespace

// The result of the job that opens a device.
struct FeelPage::Opening {
  FeelSetup setup;
  std::uint64_t revision = 0;                // of the choices
  std::shared_ptr<const LoadedScene> world;  // null: a visitor's scene
  std::uint64_t visit = 0;                   // key of that
  std::shared_ptr<TileTouches> touches;      // of that
  OpenedFeel opened;
};

void FeelPage::check_start(const DeviceKind& kind, const Request& request) const {
  if (state_ != State::kIdle) throw Advice("a scene is running already", "Stop it first.");
  if (kind.has_person && !shared_.may_command_forces) {
    throw Advice("this studio does not command forces",
                 "Other machines can reach this studio. Start it with --remote-force, or use the mouse.");
  }
  const std::optional<ClientId> owner = shared_.lease.owner(host_now_ns());
  if (owner && *owner != request.client()) {
    throw Advice("another window has the force", "Release it there, or stop the run there, first.");
  }
}

void FeelPage::begin(const Request& request) {
  const FeelChoices chosen = choices();
  const DeviceKind& kind = feel_device_kind(chosen.device);
  check_start(kind, request);
  auto opening = std::make_shared<Opening>();
  opening->revision = revision_;
  opening->setup = resolve_choices(chosen, start_, shared_.project, project_setup(shared_.document));
  opening->setup.config.feel.servo.safety.max_force_N = start_.feel.servo.safety.max_force_N;
  open_in_job(request, opening, kind.title,
              [opening, chosen, before = world_, number = ++worlds_](const Observer& observer) {
                observer.update("the scene", 0.0);
                opening->world = load_scene(opening->setup, chosen, before, number, observer);
                opening->setup = opening->world->setup;
                opening->opened = open_feel(opening->setup, *opening->world->scene, observer);
              });
}

void FeelPage::visit(const Request& request, FeelVisit visit) {
  const DeviceKind& kind = feel_device_kind(visit.setup.device);
  check_start(kind, request);
  if (!shared_.may_command_forces) {
    throw Advice("the run ended: this studio does not command forces",
                 "Other machines can reach this studio. Start it with --remote-force to allow forces.");
  }
  auto opening = std::make_shared<Opening>();
  opening->revision = revision_;
  opening->setup = std::move(visit.setup);
  opening->setup.config.feel.servo.safety.max_force_N = start_.feel.servo.safety.max_force_N;
  opening->visit = visit.key;
  opening->touches = visit.touches;
  visited_ = true;
  visit_key_ = 0;
  open_in_job(request, opening, kind.title, [opening, make = std::move(visit.make)](const Observer& observer) {
    observer.update("the scene", 0.0);
    const Scene scene = make(opening->setup);
    opening->opened = open_feel(opening->setup, scene, observer);
  });
}

void FeelPage::open_in_job(const Request& request, const std::shared_ptr<Opening>& opening, std::string_view title,
                           std::function<void(const Observer&)> open) {
  state_ = State::kOpening;
  run_owner_ = request.client();
  stop_asked_ = false;
  shared_.jobs.start_in("feel", "Starting " + std::string(title), "", std::move(open),
                        [this, request, opening](std::exception_ptr error) {
                          opened(*opening, error);
                          if (!error) return request.answer(status());
                          try {
                            std::rethrow_exception(error);
                          } catch (const std::exception& fault) {
                            request.refuse(fault);
                          }
                        });
  send_status();
}

void FeelPage::opened(Opening& opening, std::exception_ptr error) {
  state_ = State::kIdle;
  if (error || stop_asked_) {
    visited_ = false;
    return send_status();
  }
  const bool newer = revision_ != opening.revision;
  running_ = std::move(opening.opened);
  FeelRunParts parts;
  parts.device = std::move(running_.device);
  parts.model = std::move(running_.model);
  parts.servo = running_.config.feel.servo;
  parts.targets = running_.targets;
  parts.drive = std::move(running_.drive);
  parts.has_person = running_.kind.has_person;
  parts.blind = visited_;
  device_model_ = running_.info.model;
  // Those of a visitor's scene would show which texture is where.
  warnings_ = visited_ ? std::vector<std::string>() : running_.warnings;
  last_run_ = Json();
  if (opening.world) world_ = opening.world;
  visit_key_ = opening.visit;
  held_until_ns_ = 0;
  problem_.clear();
  hint_.clear();
  const std::uint64_t number = ++run_number_;
  const auto log_ended = [this, logs = finished_logs_](FinishedLog log) {
    {
      const std::lock_guard guard(logs->lock);
      logs->logs.push_back(std::move(log));
    }
    shared_.post([this] { collect_logs(); });
  };
  const auto run_ended = [this, number] {
    shared_.post([this, number] {
      if (run_ && number == run_number_) ended();
    });
  };
  run_ = std::make_unique<FeelRun>(std::move(parts), shared_.hub, number, log_ended, run_ended);
  run_->watch(opening.touches);
  run_->permit().limit(largest_force_N());
  state_ = State::kRunning;
  permit(host_now_ns());
  if (newer) load();
  send_status();
}

// Another window takes the run over: by its own request, and with the lease.
void FeelPage::take(const Request& request) {
  if (state_ == State::kIdle) throw Advice("no scene is running", "Start.");
  if (shared_.lease.owner(host_now_ns()) != request.client()) {
    throw Advice("another window has the force", "Release it there first.");
  }
  run_owner_ = request.client();
  request.done();
  send_status();
}

void FeelPage::permit(std::int64_t now_ns) {
  permitted_ = false;
  if (!run_) return;
  const bool held = visited_ && (visit_key_ == 0 || now_ns < held_until_ns_);
  permitted_ =
      state_ == State::kRunning && !held && shared_.may_command_forces && shared_.lease.owner(now_ns) == run_owner_;
  permitted_ ? run_->permit().renew() : run_->permit().revoke();
}

void FeelPage::tick(std::int64_t now_ns) {
  const bool before = permitted_;
  permit(now_ns);
  if (held_until_ns_ != 0 && now_ns >= held_until_ns_) {
    held_until_ns_ = 0;
    send_status();
  }
  if (visited_ && permitted_ != before && visit_changed_) visit_changed_();
}

void FeelPage::end_run() {
  stop_asked_ = true;
  if (run_) {
    run_->permit().revoke();
    run_->stop();
    state_ = State::kStopping;
  }
  send_status();
}

void FeelPage::pointed(ClientId client, const Pointer& pointer) {
  if (!run_ || !belongs_to(client) || shared_.lease.owner(host_now_ns()) != client) return;
  run_->point({pointer.p_world_m[0], pointer.p_world_m[1], pointer.p_world_m[2]});
}

void FeelPage::ended() {
  FeelOutcome outcome = run_->take_outcome();
  run_.reset();
  state_ = State::kIdle;
  // Its heights and parts of the force would show which texture was touched.
  last_run_ = visited_ ? Json() : outcome_json(outcome, running_.config.feel.servo);
  keep_flight_record(outcome.servo);
  running_ = {};
  visited_ = false;
  if (choices().empty()) load();
  if (outcome.failure) complain(outcome.failure);
  send_status();
}

// Of a run that a fault has ended.
void FeelPage::keep_flight_record(ServoResult& servo) {
  if (servo.end != ServoEnd::kFault) return;
  const auto ticks = std::make_shared<const std::vector<ServoTick>>(std::move(servo.last_ticks));
  shared_.jobs.start_storing(
      "feel", "Saving the record before the fault", "the record of the time before the fault is lost",
      [ticks, file = shared_.project.folder() / kFlightRecord](const Observer&) {
        refuse_stranger(file, format_flight_record({}));
        write_flight_record(file, *ticks);
      },
      [this](std::exception_ptr error) {
        if (error) return complain(error);
        warnings_.push_back(std::string("the record of the time before the fault is in ") + kFlightRecord);
        send_status();
      });
}

void FeelPage::set_log(const Request& request) {
  if (!run_) throw Advice("no scene is running", "Start a run, then write a log.");
  if (!request.flag("on")) {
    if (log_name_.empty()) throw Advice("no log is being written", "Start one first.");
    log_requests_.push_back(request);
    return run_->log().end();
  }
  if (!log_name_.empty()) throw Advice("a log is being written already", "Finish it first.");
  const std::string name = shared_.project.free_name("feel", ".csv");
  run_->log().begin(std::make_unique<FeelLog>(shared_.project.writable(name), running_.config.feel.servo.timed));
  log_name_ = name;
  Json out;
  out["log"] = name;
  request.answer(out);
  send_status();
}

// Brings the logs that a run has done with to their files, which may take a while.
void FeelPage::collect_logs() {
  for (FinishedLog& ended : finished_logs_->take()) {
    ended.log ? store_log(std::move(ended.log)) : log_is_whole(ended.fault);
  }
}

void FeelPage::store_log(std::shared_ptr<FeelLog> log) {
  shared_.jobs.start_storing(
      "feel", "Finishing the log", lost_log(log_name_), [log = std::move(log)](const Observer&) { log->commit(); },
      [this](std::exception_ptr error) {
        try {
          if (error) std::rethrow_exception(error);
          log_is_whole("");
        } catch (const std::exception& fault) {
          log_is_whole(fault.what());
        }
      });
}

void FeelPage::log_is_whole(const std::string& fault) {
  Json out;
  out["log"] = std::exchange(log_name_, {});
  if (!fault.empty()) {
    problem_ = "the log is lost: " + fault;
    hint_ = "Free some space, or check that the folder is writable; the run continues.";
  }
  for (const Request& request : std::exchange(log_requests_, {})) {
    fault.empty() ? request.answer(out) : request.refuse(Advice(problem_, hint_));
  }
  send_status();
}

// Nothing is posted to this thread any more: what the run leaves is stored by jobs, for which the end waits.
void FeelPage::stop() {
  if (run_) {
    run_->stop();
    FeelOutcome outcome = run_->take_outcome();
    run_.reset();
    state_ = State::kIdle;
    keep_flight_record(outcome.servo);
  }
  for (FinishedLog& ended : finished_logs_->take()) {
    if (!ended.log)
      shared_.report_loss(lost_log(log_name_) + ": " + ended.fault);
    else
      store_log(std::move(ended.log));
  }
}

}  // namespace asperity::studio

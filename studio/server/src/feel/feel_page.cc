#include "feel/feel_page.h"

#include <algorithm>
#include <utility>

#include "asperity/acquire/host_clock.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/device/write_flight_record.h"
#include "config_fields.h"
#include "feel/feel_json.h"
#include "our_file.h"

namespace asperity::studio {

namespace {

constexpr const char* kModelSlot = "feel.scene";
constexpr const char* kSwapSlot = "feel.swap";
constexpr const char* kFlightRecord = "asperity-feel.flight.csv";

}  // namespace

// What the job that opens a device hands over.
struct FeelPage::Opening {
  FeelSetup setup;
  std::shared_ptr<const FeltWorld> world;
  OpenedFeel opened;
};

FeelPage::FeelPage(Shared& shared, FeelConfig start) : shared_(shared), start_(std::move(start)) {}
FeelPage::~FeelPage() = default;

FeelChoices FeelPage::choices() const { return read_feel_choices(shared_.document.section("feel")); }

double FeelPage::largest_force_N() const {
  const double most_N = start_.feel.servo.safety.max_force_N;
  return std::min(most_N, choices().max_force_N.value_or(most_N));
}

void FeelPage::bind(Document& document, Calls& calls) {
  document.add_section("feel", first_feel_section(), [start = start_](const Json& section) {
    const FeelChoices chosen = read_feel_choices(section);
    feel_device_kind(chosen.device);
    FeelConfig config = start;
    const std::vector<ConfigField> fields = settable_fields(config);
    for (const auto& [path, value] : chosen.settings) set_field(fields, path, value);
  });
  calls.add("feel.status", [this](const Request& request) { request.answer(status()); });
  calls.add("feel.fields", [this](const Request& request) { request.answer(fields()); });
  calls.add("feel.devices", [this](const Request& request) { request.answer(feel_devices_json(start_)); });
  calls.add("feel.open", [this](const Request& request) {
    if (!world_) {
      throw Advice(problem_.empty() ? "there is no scene yet" : problem_,
                   hint_.empty() ? "Choose a scene, a mesh or height maps." : hint_);
    }
    request.answer(world_->block);
  });
  calls.add("feel.start", [this](const Request& request) { begin(request); });
  calls.add("feel.stop", [this](const Request& request) {
    stop_asked_ = true;
    if (run_) {
      run_->permit().revoke();
      run_->stop();
      state_ = State::kStopping;
    }
    request.done();
    tell();
  });
  calls.add("feel.log", [this](const Request& request) { set_log(request); });
}

void FeelPage::start() { load(); }

void FeelPage::edited(const Edit& edit) {
  if (!edit.path.starts_with("/feel")) return;
  ++revision_;
  if (run_) run_->permit().limit(largest_force_N());
  // The device and its limit are none of the scene's.
  if (edit.path != "/feel/device" && edit.path != "/feel/max_force_N") load();
  tell();
}

void FeelPage::load() {
  const FeelChoices chosen = choices();
  if (chosen.empty()) {
    world_.reset();
    problem_.clear();
    hint_.clear();
    return tell();
  }
  auto result = std::make_shared<std::shared_ptr<const FeltWorld>>();
  try {
    FeelSetup setup = resolve_choices(chosen, start_, shared_.project);
    loading_ = true;
    shared_.jobs.start(
        "Reading what is to be felt", kModelSlot,
        [result, chosen, setup = std::move(setup), before = world_, revision = revision_](const Observer& observer) {
          observer.update("reading", 0.0);
          *result = make_felt_world(setup, chosen, before, revision);
        },
        [this, result, revision = revision_](std::exception_ptr error) {
          if (revision == revision_ || !error) loading_ = false;
          if (error) return complain(error);
          loaded(*result);
        });
  } catch (const std::exception&) {
    complain(std::current_exception());
  }
  tell();
}

void FeelPage::loaded(std::shared_ptr<const FeltWorld> world) {
  world_ = std::move(world);
  problem_.clear();
  hint_.clear();
  if (run_ && state_ == State::kRunning) swap_model();
  tell();
}

// The model for the running device is built beside the loop and taken between two of its ticks.
void FeelPage::swap_model() {
  auto result = std::make_shared<app::FeltModel>();
  shared_.jobs.start(
      "Bringing the change to the device", kSwapSlot,
      [result, world = world_, info = running_.info, kind = running_.kind, config = running_.config](const Observer&) {
        *result = make_swapped_model(*world, info, kind.driven || kind.name == "mouse", config);
      },
      [this, result, number = run_number_](std::exception_ptr error) {
        if (error) return complain(error);
        if (!run_ || number != run_number_) return;
        run_->swap(std::move(result->model));
        warnings_ = std::move(result->warnings);
        tell();
      });
}

// A scene that cannot be read leaves the one before as it is.
void FeelPage::complain(std::exception_ptr error) {
  try {
    std::rethrow_exception(error);
  } catch (const Cancelled&) {
    return;
  } catch (const Advice& advice) {
    problem_ = advice.what();
    hint_ = advice.hint();
  } catch (const std::exception& fault) {
    problem_ = fault.what();
    hint_ = world_ ? "What was felt before is as it was; change the choice, or undo it." : "Choose something else.";
  }
  tell();
}

void FeelPage::begin(const Request& request) {
  if (state_ != State::kIdle) throw Advice("a scene is being felt already", "Stop it first.");
  const FeelChoices chosen = choices();
  const FeelDeviceKind& kind = feel_device_kind(chosen.device);
  if (kind.felt && !shared_.may_command_forces) {
    throw Advice("forces are not commanded from here",
                 "The studio listens to other machines: start it with --remote-force, or look on with the mouse.");
  }
  const std::optional<ClientId> owner = shared_.lease.owner(host_now_ns());
  if (owner && *owner != request.client()) {
    throw Advice("another window has the force", "Let it go there, or stop the run there, first.");
  }
  auto opening = std::make_shared<Opening>();
  opening->setup = resolve_choices(chosen, start_, shared_.project);
  opening->setup.config.feel.servo.safety.max_force_N = start_.feel.servo.safety.max_force_N;
  state_ = State::kOpening;
  stop_asked_ = false;
  shared_.jobs.start_in(
      "feel", "Starting " + std::string(kind.title), "",
      [opening, chosen, before = world_, revision = revision_](const Observer& observer) {
        observer.update("the scene", 0.0);
        opening->world = make_felt_world(opening->setup, chosen, before, revision);
        opening->setup = opening->world->setup;
        opening->opened = open_feel(opening->setup, *opening->world->scene, observer);
      },
      [this, request, opening](std::exception_ptr error) {
        opened(*opening, error);
        if (!error) return request.answer(status());
        try {
          std::rethrow_exception(error);
        } catch (const std::exception& fault) {
          request.refuse(fault);
        }
      });
  tell();
}

void FeelPage::opened(Opening& opening, std::exception_ptr error) {
  state_ = State::kIdle;
  if (error || stop_asked_) return tell();
  const bool newer = revision_ != opening.world->revision;
  running_ = std::move(opening.opened);
  FeelRunParts parts;
  parts.device = std::move(running_.device);
  parts.model = std::move(running_.model);
  parts.servo = running_.config.feel.servo;
  parts.targets = running_.targets;
  parts.drive = std::move(running_.drive);
  parts.felt = running_.kind.felt;
  device_model_ = running_.info.model;
  warnings_ = running_.warnings;
  last_run_ = Json();
  world_ = opening.world;
  problem_.clear();
  hint_.clear();
  const std::uint64_t number = ++run_number_;
  run_ = std::make_unique<FeelRun>(std::move(parts), shared_.hub, number, [this, number] {
    shared_.post([this, number] {
      if (run_ && number == run_number_) ended();
    });
  });
  run_->permit().limit(largest_force_N());
  state_ = State::kRunning;
  permit(host_now_ns());
  if (newer) load();
  tell();
}

void FeelPage::permit(std::int64_t now_ns) {
  if (!run_) return;
  if (state_ == State::kRunning && shared_.may_command_forces && shared_.lease.owner(now_ns)) {
    run_->permit().renew();
  } else {
    run_->permit().revoke();
  }
}

void FeelPage::tick(std::int64_t now_ns) { permit(now_ns); }

void FeelPage::pointed(ClientId client, const Pointer& pointer) {
  if (!run_ || shared_.lease.owner(host_now_ns()) != client) return;
  run_->point({pointer.p_world_m[0], pointer.p_world_m[1], pointer.p_world_m[2]});
}

void FeelPage::ended() {
  FeelOutcome outcome = run_->take_outcome();
  finish_log();
  run_.reset();
  state_ = State::kIdle;
  last_run_ = outcome_json(outcome, running_.config.feel.servo);
  if (outcome.failure) complain(outcome.failure);
  if (outcome.servo.end == ServoEnd::kFault) keep_flight_record(outcome.servo);
  running_ = {};
  tell();
}

void FeelPage::keep_flight_record(const ServoResult& servo) {
  try {
    const std::filesystem::path file = shared_.project.writable(kFlightRecord);
    app::refuse_stranger(file, format_flight_record({}));
    write_flight_record(file, servo.last_ticks);
    warnings_.push_back(std::string("what happened before the fault is in ") + kFlightRecord);
  } catch (const Error& error) {
    warnings_.push_back(std::string("no flight record: ") + error.what());
  }
}

void FeelPage::set_log(const Request& request) {
  const bool on = request.flag("on");
  if (!on) {
    const std::string name = log_name_;
    finish_log();
    Json out;
    out["log"] = name;
    request.answer(out);
    return tell();
  }
  if (!run_) throw Advice("nothing is felt at the moment", "Start, then log.");
  const std::string name = free_log_name(shared_.project);
  run_->start_log(std::make_unique<app::FeelLog>(shared_.project.writable(name), running_.config.feel.servo.timed));
  log_name_ = name;
  Json out;
  out["log"] = name;
  request.answer(out);
  tell();
}

void FeelPage::finish_log() {
  if (!run_ || log_name_.empty()) return;
  log_name_.clear();
  try {
    run_->finish_log();
  } catch (const std::exception&) {
    complain(std::current_exception());
  }
}

void FeelPage::stop() {
  if (!run_) return;
  run_->stop();
  run_->take_outcome();
  finish_log();
  run_.reset();
  state_ = State::kIdle;
}

Json FeelPage::fields() const {
  FeelConfig first = start_, chosen = start_;
  const std::vector<ConfigField> fields = settable_fields(chosen);
  for (const auto& [path, value] : choices().settings) set_field(fields, path, value);
  return fields_json(fields, settable_fields(first));
}

Json FeelPage::status() const {
  static constexpr std::array<const char*, 4> kStates{"idle", "opening", "running", "stopping"};
  Json out;
  out["state"] = kStates.at(static_cast<std::size_t>(state_));
  out["run"] = run_number_;
  out["device"] = run_ ? std::string(running_.kind.name) : choices().device;
  out["device_model"] = run_ ? device_model_ : "";
  out["rate_Hz"] = run_ ? running_.config.feel.servo.rate_Hz : 0.0;
  out["real_forces"] = run_ && running_.kind.felt;
  out["loading"] = loading_;
  out["revision"] = world_ ? Json(world_->revision) : Json();
  out["title"] = world_ ? world_->title : "";
  out["problem"] = problem_;
  out["hint"] = hint_;
  out["warnings"] = warnings_;
  out["may_command_forces"] = shared_.may_command_forces;
  out["max_force_N"] = largest_force_N();
  out["most_force_N"] = start_.feel.servo.safety.max_force_N;
  out["log"] = log_name_;
  out["last_run"] = last_run_;
  return out;
}

// Says how things stand if that is another than before.
void FeelPage::tell() {
  Json now = status();
  if (now == told_) return;
  told_ = now;
  shared_.hub.broadcast("feel", now);
}

std::unique_ptr<Page> make_feel_page(Shared& shared) { return std::make_unique<FeelPage>(shared); }

}  // namespace asperity::studio

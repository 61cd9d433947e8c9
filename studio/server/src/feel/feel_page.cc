#include "feel/feel_page.h"

#include <algorithm>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "complaint.h"
#include "config_fields.h"
#include "feel/finished_logs.h"

namespace asperity::studio {

namespace {

constexpr const char* kModelSlot = "feel.scene";
constexpr const char* kSwapSlot = "feel.swap";

// The project's unit is that of a mesh without one.
bool changes_scene(const Edit& edit) { return edit.path == "/project" || edit.path.starts_with("/project/mesh_unit"); }

}  // namespace

FeelPage::FeelPage(Shared& shared, FeelConfig start)
    : shared_(shared), start_(std::move(start)), finished_logs_(std::make_shared<FinishedLogs>()) {}
FeelPage::~FeelPage() = default;

FeelChoices FeelPage::choices() const { return read_feel_choices(shared_.document.section("feel")); }

double FeelPage::largest_force_N() const {
  const double most_N = start_.feel.servo.safety.max_force_N;
  return std::min(most_N, choices().max_force_N.value_or(most_N));
}

void FeelPage::bind(Document& document, Calls& calls) {
  const auto check = [start = start_](const Json& section) {
    const FeelChoices chosen = read_feel_choices(section);
    feel_device_kind(chosen.device);
    FeelConfig config = start;
    const std::vector<ConfigField> fields = settable_fields(config);
    for (const auto& [path, value] : chosen.settings) set_field(fields, path, value);
  };
  document.add_section("feel", first_feel_section(), check, [start = start_](Json& section) {
    FeelConfig config = start;
    use_present_names(section, "settings", settable_fields(config));
  });
  calls.add("feel.status", [this](const Request& request) { request.answer(status()); });
  calls.add("feel.fields", [this](const Request& request) { request.answer(fields()); });
  calls.add("feel.devices", [this](const Request& request) { request.answer(feel_devices_json(start_)); });
  calls.add("feel.open", [this](const Request& request) {
    if (!world_) {
      throw Advice(problem_.empty() ? "no scene is open yet" : problem_,
                   hint_.empty() ? "Choose a scene, a mesh or height maps." : hint_);
    }
    request.answer(world_->block);
  });
  calls.add("feel.start", [this](const Request& request) { begin(request); });
  calls.add("feel.stop", [this](const Request& request) {
    end_run();
    request.done();
  });
  calls.add("feel.take", [this](const Request& request) { take(request); });
  calls.add("feel.log", [this](const Request& request) { set_log(request); });
}

void FeelPage::start() { load(); }

void FeelPage::edited(const Edit& edit) {
  if (!changes_scene(edit) && !edit.path.starts_with("/feel")) return;
  ++revision_;
  if (run_) run_->permit().limit(largest_force_N());
  // The device and its limit are none of the scene's.
  if (edit.path != "/feel/device" && edit.path != "/feel/max_force_N") load();
  send_status();
}

// While a scene is rendered, what is under the hand is changed by the one whose hand it is; others may make it safer.
void FeelPage::check_edit(ClientId client, const Edit& edit) const {
  if (state_ == State::kIdle || (!edit.path.starts_with("/feel") && !changes_scene(edit)) ||
      (belongs_to(client) && !visited_))
    return;
  const bool is_number = edit.path == "/feel/max_force_N" && edit.after.is_number();
  if (is_number && edit.after.get<double>() <= largest_force_N()) return;
  if (visited_) throw Advice("a study is running", "You can stop it or lower its largest force.");
  throw Advice("another window is running this scene",
               "You can stop it or lower its largest force. To change it, stop it, or take the force when that "
               "window has released it.");
}

void FeelPage::load() {
  const FeelChoices chosen = choices();
  if (chosen.empty()) {
    // What is under the hand stays there, and is shown, until it is stopped.
    loading_ = false;
    const bool is_felt = run_ && !visited_ && world_;
    if (!is_felt) world_.reset();
    problem_ = is_felt ? "nothing is chosen" : "";
    hint_ = is_felt ? "The run continues with " + world_->title + " until you stop. Choose something else, or undo it."
                    : "";
    return send_status();
  }
  auto result = std::make_shared<std::shared_ptr<const LoadedScene>>();
  try {
    FeelSetup setup = resolve_choices(chosen, start_, shared_.project, project_setup(shared_.document));
    loading_ = true;
    shared_.jobs.start(
        "Reading the scene", kModelSlot,
        [result, chosen, setup = std::move(setup), before = world_, number = ++worlds_](const Observer& observer) {
          observer.update("reading", 0.0);
          *result = load_scene(setup, chosen, before, number, observer);
        },
        [this, result, revision = revision_](std::exception_ptr error) {
          if (revision == revision_ || !error) loading_ = false;
          if (choices().empty()) return send_status();  // nothing is chosen any more
          if (error) return complain(error);
          loaded(*result);
        });
  } catch (const std::exception&) {
    complain(std::current_exception());
  }
  send_status();
}

void FeelPage::loaded(std::shared_ptr<const LoadedScene> world) {
  world_ = std::move(world);
  problem_.clear();
  hint_.clear();
  if (run_ && state_ == State::kRunning && !visited_) swap_model();
  send_status();
}

// The model for the running device is built next to the loop and taken between two of its ticks.
void FeelPage::swap_model() {
  auto result = std::make_shared<PreparedModel>();
  shared_.jobs.start(
      "Sending the change to the device", kSwapSlot,
      [result, world = world_, info = running_.info, kind = running_.kind, config = running_.config](const Observer&) {
        *result = prepare_swapped_model(*world, info, kind.driven() || kind.name == "mouse", config);
      },
      [this, result, number = run_number_](std::exception_ptr error) {
        if (error) return complain(error);
        if (!run_ || number != run_number_) return;
        run_->swap(std::move(result->model));
        warnings_ = std::move(result->warnings);
        send_status();
      });
}

// A scene that cannot be read leaves the one before as it is.
void FeelPage::complain(std::exception_ptr error) {
  auto complaint = complaint_of(
      error, world_ ? "The scene before is unchanged. Change the choice, or undo it." : "Choose something else.");
  if (!complaint) return;
  problem_ = std::move(complaint->problem);
  hint_ = std::move(complaint->hint);
  send_status();
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
  out["real_forces"] = run_ && running_.kind.has_person;
  out["owner"] = state_ == State::kIdle ? Json() : Json(run_owner_);
  out["visited"] = visited_;
  out["held"] = visited_ && (visit_key_ == 0 || held_until_ns_ != 0);
  out["loading"] = loading_;
  out["revision"] = world_ ? Json(world_->drawn) : Json();
  out["felt"] = world_ ? Json(world_->number) : Json();
  out["models"] = world_ ? Json(world_->models) : Json::array();
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

// Sends the status if it has changed.
void FeelPage::send_status() {
  Json now = status();
  if (now == sent_status_) return;
  sent_status_ = now;
  shared_.hub.broadcast("feel", now);
  if (visit_changed_) visit_changed_();
}

std::unique_ptr<FeelPage> make_feel_page(Shared& shared) {
  return std::make_unique<FeelPage>(shared, shared.feel ? *shared.feel : FeelConfig());
}

}  // namespace asperity::studio

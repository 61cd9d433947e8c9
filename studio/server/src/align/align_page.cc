#include "align/align_page.h"

#include <array>
#include <span>
#include <string>
#include <utility>

#include "align/list_paths.h"
#include "align/residual_block.h"
#include "align/write_alignment.h"
#include "asperity/base/error.h"
#include "asperity/pipeline/earlier_scene.h"
#include "asperity/registration/manual_alignment.h"
#include "config_fields.h"
#include "json_pose.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

constexpr const char* kSection = "align";

void check_section(const Json& section) { choice_of_json(section); }

Pose pose_argument(const Request& request, std::string_view name) {
  return pose_of_json(request.args().value(std::string(name), Json()), request.name() + ": " + std::string(name));
}

std::array<double, 3> three(const Request& request, std::string_view name) {
  const std::vector<double> v = request.numbers(name, 3);
  return {v[0], v[1], v[2]};
}

// The checksum of a scene as it is now; "" if it cannot be read.
std::string scene_version(const Project& project, const std::string& name) {
  try {
    const std::filesystem::path file = project.existing(name);
    return scene_checksum(file.parent_path(), file.filename().string());
  } catch (const Error&) {
    return "";
  }
}

// A file that states its unit has the same one in each run. Of others it is the length that counts, not its text.
bool has_unit_of(const AlignChoice::LastRun& ran, const MeshReading& reading) {
  if (reading.from == MeshReading::From::kFile) return true;
  return parse_length_unit_m(ran.mesh_unit.empty() ? "m" : ran.mesh_unit, "the mesh's unit") == reading.unit_m;
}

}  // namespace

void AlignPage::bind(Document& document, Calls& calls) {
  document.add_section(kSection, json_of_choice({}), check_section, [](Json& section) {
    RegisterConfig config;
    const std::vector<ConfigField> fields = list_fields("", config);
    use_present_names(section, "config", fields);
    if (Json* const ran = section.find("ran")) use_present_names(*ran, "config", fields);
    if (section.is_object() && !section.contains("area")) section["area"] = json_of_choice({}).at("area");
  });
  areas_.bind(calls);
  calls.add("align.paths", [this](const Request& request) {
    answer_in_lane(shared_.jobs, "project", request, "", "",
                   [project = shared_.project](const Observer&) { return list_paths(project); });
  });
  calls.add("align.config", [this](const Request& request) {
    RegisterConfig config = config_of(choice()), first;
    request.answer(fields_json(list_fields("", config), list_fields("", first)));
  });
  calls.add("align.open", [this](const Request& request) { open(request); });
  calls.add("align.sliders", [this](const Request& request) { turn_sliders(request); });
  calls.add("align.pick", [this](const Request& request) { pick(request); });
  calls.add("align.residuals", [this](const Request& request) { measure(request); });
  calls.add("align.judge", [this](const Request& request) { judge(request); });
  calls.add("align.run", [this](const Request& request) { run(request); });
  calls.add("align.iterations",
            [this](const Request& request) { request.answer(log_ ? log_->all() : IterationLog(0).all()); });
  calls.add("align.result", [this](const Request& request) {
    const bool current = last_ && last_->scene == scene_ && scene_ && is_same_scene(scene_->of, choice());
    request.answer(current ? json_of_run(*last_) : Json());
  });
  calls.add("align.accept", [this](const Request& request) { accept(request); });
  calls.add("align.write", [this](const Request& request) { write(request); });
}

void AlignPage::tick(std::int64_t) { send_iterations(); }

AlignChoice AlignPage::choice() const {
  AlignChoice out = choice_of_json(shared_.document.section(kSection));
  out.project = project_setup(shared_.document);
  return out;
}

Json AlignPage::ran() const { return shared_.document.section(kSection).value("ran", Json()); }

Pose AlignPage::pose(const AlignScene& scene) const { return choice().T_mesh_world.value_or(start_pose(scene)); }

std::shared_ptr<const AlignScene> AlignPage::scene() const {
  if (!scene_ || !is_same_scene(scene_->of, choice())) {
    throw Advice("the mesh and the scan are not open", "Wait until they are read, or choose them again.");
  }
  return scene_;
}

void AlignPage::open(const Request& request) {
  const AlignChoice wanted = choice();
  // A scene to which scans were added is another one.
  const std::string version = is_of_scene(wanted) ? scene_version(shared_.project, wanted.mesh) : "";
  if (scene_ && scene_->version == version && is_same_scene(scene_->of, wanted)) {
    request.answer(BlockWriter(*block_));
    return follow_document();
  }
  struct Opened {
    std::shared_ptr<const AlignScene> scene;
    std::shared_ptr<const BlockWriter> block;
  };
  auto made = std::make_shared<Opened>();
  shared_.jobs.start(
      "Opening " + wanted.mesh, "align.open",
      [made, wanted, project = shared_.project](const Observer& observer) {
        made->scene = load_align_scene(wanted, project, observer);
        observer.update("drawing", 0.9);
        made->block = std::make_shared<const BlockWriter>(align_block(*made->scene));
      },
      [this, made, request](std::exception_ptr error) {
        try {
          if (error) std::rethrow_exception(error);
          scene_ = made->scene;
          block_ = made->block;
          closest_ = std::make_shared<std::vector<ClosestPoint>>();
          request.answer(BlockWriter(*block_));
          follow_document();
        } catch (const std::exception& fault) {
          request.refuse(fault);
        }
      });
}

void AlignPage::turn_sliders(const Request& request) const {
  const std::array<double, 3> about =
      request.has("about_world_m") ? three(request, "about_world_m") : std::array<double, 3>{};
  const Eigen::Vector3d pivot_m(about[0], about[1], about[2]);
  if (request.has("pose") && (request.has("shift_m") || request.has("turn_deg"))) {
    throw Error("align.sliders: a pose or its six numbers, not both");
  }
  Pose pose;
  if (request.has("pose")) {
    pose = pose_argument(request, "pose");
  } else {
    pose = align_manually({three(request, "shift_m"), three(request, "turn_deg")});
    pose.translation_m -= pose.rotation * pivot_m;
  }
  // The six numbers are those of the pose from a world whose origin is the pivot.
  const ManualAlignment six = manual_alignment({pose.rotation, pose * pivot_m});
  Json out;
  out["pose"] = json_of_pose(pose);
  out["shift_m"] = six.shift_m;
  out["turn_deg"] = six.rotation_deg;
  request.answer(out);
}

void AlignPage::pick(const Request& request) {
  std::vector<Eigen::Vector3d> p_world_m, p_mesh_m;
  for (const AlignChoice::Pick& pair : choice().picks) {
    p_world_m.push_back(pair.p_world_m);
    p_mesh_m.push_back(pair.p_mesh_m);
  }
  if (p_world_m.size() < 3) {
    throw Advice("there are " + std::to_string(p_world_m.size()) + " pairs of points, and three are needed",
                 "Pick more points on the path, each with its point on the mesh.");
  }
  const AbsoluteOrientation found = align_picked(p_world_m, p_mesh_m);
  Json out;
  out["T_mesh_world"] = json_of_pose(found.T_b_a);
  out["rms_m"] = found.rms_m;
  shared_.document.edit("/align/T_mesh_world", out["T_mesh_world"], "align the picked points");
  request.answer(out);
}

// On a lane of its own, for the path is moved while a registration runs. Scans of other placements have poses of their
// own: their points are measured where those put them.
void AlignPage::measure(const Request& request) {
  const std::shared_ptr<const AlignScene> scene = this->scene();
  std::vector<Pose> poses;
  if (const Json* given = request.args().find("poses")) {
    if (!given->is_array() || given->size() != scene->of.paths.size())
      throw Error("align.residuals: poses: one pose for each path is needed");
    for (const Json& pose : *given) poses.push_back(pose_of_json(pose, "align.residuals: poses"));
  }
  answer_in_lane(shared_.jobs, "align residuals", request, "", "",
                 [scene, closest = closest_, pose = pose_argument(request, "pose"),
                  poses = std::move(poses)](const Observer&) { return residual_block(*scene, pose, poses, *closest); });
}

// A verdict belongs to a pose: one that is placed by hand has its own.
void AlignPage::judge(const Request& request) {
  const std::shared_ptr<const AlignScene> scene = this->scene();
  std::optional<PoseCandidates> known;
  if (last_ && last_->scene == scene && !last_->candidates.found.empty()) known = last_->candidates;
  answer_in_lane(shared_.jobs, "align verdict", request, "", "",
                 [scene, wanted = choice(), known = std::move(known), pose = pose_argument(request, "pose")](
                     const Observer& observer) { return judge_by_hand(*scene, wanted, pose, known, observer); });
}

void AlignPage::run(const Request& request) {
  const std::shared_ptr<const AlignScene> scene = this->scene();
  const std::optional<Pose> guess = request.flag("guess") ? std::optional<Pose>(pose(*scene)) : std::nullopt;
  const AlignChoice by = choice();
  const AlignChoice::LastRun ran{guess, by.paths, by.mesh, reading_of(by).text, by.config};
  register_from(guess, by.config, guess ? "Registering from the pose shown" : "Registering from anywhere",
                [this, request, ran = json_of_last_run(ran), from_here = guess.has_value()](std::exception_ptr error) {
                  try {
                    if (error) std::rethrow_exception(error);
                    const Json result = json_of_run(*last_);
                    // Known before the document's change is heard, which then asks for no other result.
                    sent_ran_ = ran;
                    if (this->ran() != ran)
                      shared_.document.edit("/align/ran", ran, from_here ? "register" : "register from anywhere");
                    request.answer(result);
                  } catch (const std::exception& fault) {
                    request.refuse(fault);
                  }
                });
}

void AlignPage::register_from(const std::optional<Pose>& guess, const std::map<std::string, std::string>& config,
                              const std::string& title, std::function<void(std::exception_ptr)> after) {
  const std::shared_ptr<const AlignScene> scene = this->scene();
  AlignChoice wanted = choice();
  wanted.config = config;
  const std::uint64_t number = ++runs_;
  send_iterations();
  log_ = std::make_shared<IterationLog>(number);
  running_ = true;
  auto made = std::make_shared<AlignRun>();
  shared_.jobs.start(
      title, "align.run",
      [made, scene, wanted, guess, number, log = log_](const Observer& observer) {
        RegistrationObserver watched(observer);
        watched.iterated = [log](const RegistrationIteration& iteration) { log->add(iteration); };
        *made = run_align(number, scene, wanted, guess, watched);
      },
      [this, made, scene, number, after = std::move(after)](std::exception_ptr error) {
        if (number == runs_) running_ = false;
        send_iterations();
        if (!error && !is_same_scene(scene->of, choice())) {
          sent_ran_ = Json();  // needed again with those files
          error = std::make_exception_ptr(
              Advice("the scans or the mesh were changed while they were registered", "Register again."));
        }
        if (!error) finish(std::move(*made));
        after(error);
        if (!running_) follow_document();
      });
}

void AlignPage::finish(AlignRun run) {
  last_ = std::move(run);
  shared_.hub.broadcast("align.result", json_of_run(*last_));
}

void AlignPage::forget_result() {
  if (!last_) return;
  last_.reset();
  log_.reset();
  shared_.hub.broadcast("align.result", Json());
}

void AlignPage::follow_document() {
  const AlignChoice wanted = choice();
  if (running_ || !scene_ || !is_same_scene(scene_->of, wanted)) return;
  const auto& of = wanted.ran;
  if (!of || of->paths != wanted.paths || of->mesh != wanted.mesh || !has_unit_of(*of, reading_of(wanted))) {
    sent_ran_ = Json();
    return forget_result();
  }
  if (ran() == sent_ran_ && (!last_ || last_->scene == scene_)) return;
  sent_ran_ = ran();
  forget_result();
  register_from(of->guess, of->config, "Registering again, as before", [](std::exception_ptr) {});
}

void AlignPage::edited(const Edit& edit) {
  // A change of the files is followed once they are open.
  if (edit.path == "/align" || edit.path.starts_with("/align/ran") || edit.path.starts_with("/project"))
    follow_document();
}

void AlignPage::accept(const Request& request) {
  const std::string solution = request.text("solution");
  if (solution != "best" && solution != "runner_up") {
    throw Error("align.accept: solution: '" + solution + "' is neither 'best' nor 'runner_up'");
  }
  if (!last_ || last_->scene != scene()) {
    throw Advice("these scans are not registered on this mesh", "Register first.");
  }
  AlignChoice taken = choice();
  if (solution == "best") {
    taken.registered = last_->how;
  } else {
    if (!last_->result.runner_up) throw Advice("the registration has no runner-up", "Accept its best pose.");
    const Pose& other = last_->result.runner_up->T_mesh_world;
    taken.registered = AlignChoice::Registered{other, true, other};
  }
  taken.T_mesh_world = taken.registered->T_mesh_world;
  Json section = json_of_choice(taken);
  if (!ran().is_null()) section["ran"] = ran();  // as it was given, to the last digit
  shared_.document.edit("/align", section, solution == "best" ? "accept the registered pose" : "accept the runner-up");
  request.done();
}

void AlignPage::write(const Request& request) {
  AlignChoice taken = choice();
  const bool into = request.has("into") && request.flag("into");
  const std::optional<std::string> name = into ? std::nullopt : std::optional(request.text("name"));
  if (name) write_target(shared_.project, request);
  answer_by_job(shared_.jobs, request, "Writing " + name.value_or(taken.mesh), "align.write",
                [taken = std::move(taken), name, project = shared_.project, hub = &shared_.hub](
                    const Observer& observer) { return write_alignment(taken, project, name, *hub, observer); });
}

void AlignPage::send_iterations() {
  if (!log_) return;
  if (std::optional<BlockWriter> news = log_->take_news()) {
    shared_.hub.publish("align.iteration", news->take(), Delivery::kSeries);
  }
}

std::unique_ptr<Page> make_align_page(Shared& shared) { return std::make_unique<AlignPage>(shared); }

}  // namespace asperity::studio

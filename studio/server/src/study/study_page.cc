#include "study/study_page.h"

#include <array>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/studio/calls.h"
#include "asperity/study/format_study_results.h"
#include "asperity/study/study_file.h"
#include "complaint.h"
#include "config_fields.h"
#include "feel/feel_devices.h"
#include "json_keys.h"
#include "study/study_advice.h"
#include "study/trial_scene.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

struct Section {
  Study study;
  std::string participant;
};

Section read_section(const Json& section) {
  if (!section.is_object()) throw Error("study: an object is needed");
  refuse_unknown(section, {"study", "participant"}, "study");
  Section out;
  if (section.contains("study")) out.study = read_study(section["study"], "study");
  feel_device_kind(out.study.presentation.device);
  if (!section.contains("participant")) return out;
  if (!section["participant"].is_string()) throw Error("study: participant: text is needed");
  out.participant = section["participant"].get<std::string>();
  if (!out.participant.empty()) advised([&] { check_participant(out.participant); });
  return out;
}

Study read_study_file(const Project& project, const std::string& name) {
  if (!name.ends_with(kStudyEnding)) {
    throw Advice(printable(name, 200) + ": is not a *" + std::string(kStudyEnding),
                 "Choose a study that this page wrote.");
  }
  return advised([&] { return parse_study_file(read_file(project.existing(name), kLargestStudy_bytes), name); });
}

StudyLog read_log(const Project& project, const std::string& name) {
  if (!name.ends_with(kStudyLogEnding)) {
    throw Advice(printable(name, 200) + ": is not the log of a study",
                 "Choose a file that ends with " + std::string(kStudyLogEnding) + ".");
  }
  return advised([&] { return parse_study_log(read_file(project.existing(name), kLargestStudyLog_bytes), name); });
}

// Writes the results of a log next to it, under its name, which states the run: x_2.results.json of x_2.study.csv.
// Others that are there stay, and these become x_2.results_2.json; the same ones are not written again. Gives the name.
std::string keep_results(const Project& project, const std::string& log, const std::string& content) {
  const std::string file = project.existing(log).lexically_relative(project.folder()).generic_string();
  const std::string stem = file.substr(0, file.size() - kStudyLogEnding.size()) + ".results";
  std::string name = stem + ".json";
  std::error_code error;
  for (int k = 2; is_taken(project.folder() / name); ++k) {
    const fs::path there = project.folder() / name;
    if (fs::file_size(there, error) == content.size() && read_file(there, content.size()) == content) return name;
    name = stem + '_' + std::to_string(k) + ".json";
  }
  write_file(project.writable(name), content);
  return name;
}

}  // namespace

StudyPage::StudyPage(Shared& shared, FeelHost& host, FeelConfig start)
    : shared_(shared), host_(host), start_(std::move(start)) {}

Study StudyPage::study() const { return read_section(shared_.document.section("study")).study; }

void StudyPage::bind(Document& document, Calls& calls) {
  Json first;
  first["study"] = study_json(Study());
  first["participant"] = "";
  document.add_section("study", std::move(first), [](const Json& section) { read_section(section); });
  host_.on_visit([this] { follow_touch(); });
  bind_setup(calls);
  bind_logs(calls);
  bind_session(calls);
}

void StudyPage::bind_setup(Calls& calls) {
  calls.add("study.status", [this](const Request& request) { request.answer(status()); });
  calls.add("study.fields", [this](const Request& request) {
    Study chosen = study(), first;
    std::vector<ConfigField> fields, defaults;
    std::vector<ConfigField> all = list_fields("", chosen), all_defaults = list_fields("", first);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].path.find('.') == std::string::npos) continue;
      fields.push_back(std::move(all[k]));
      defaults.push_back(std::move(all_defaults[k]));
    }
    request.answer(fields_json(fields, defaults));
  });
  calls.add("study.read", [this](const Request& request) {
    answer_by_job(shared_.jobs, request, "", "",
                  [project = shared_.project, name = request.text("name")](const Observer&) {
                    return study_json(read_study_file(project, name));
                  });
  });
  calls.add("study.write", [this](const Request& request) {
    if (!request.text("name").ends_with(kStudyEnding)) {
      throw Advice(printable(request.text("name"), 200) + ": is not the name of a study",
                   "Give it the ending " + std::string(kStudyEnding) + ".");
    }
    answer_by_job(shared_.jobs, request, "", "",
                  [target = write_target(shared_.project, request), content = format_study_file(study()),
                   name = request.text("name")](const Observer&) {
                    write_file(target, content);
                    Json out;
                    out["name"] = name;
                    return out;
                  });
  });
}

void StudyPage::bind_logs(Calls& calls) {
  const auto check_closed = [this](const Request& request) {
    const std::filesystem::path asked = shared_.project.existing(request.text("log"));
    std::error_code error;
    if (session_ && std::filesystem::equivalent(asked, shared_.project.folder() / log_name_, error)) {
      throw Advice("this log is being written",
                   "Its results are shown after the session, so that they cannot influence the answers.");
    }
  };
  calls.add("study.results", [this, check_closed](const Request& request) {
    check_closed(request);
    answer_by_job(shared_.jobs, request, "", "",
                  [project = shared_.project, name = request.text("log")](const Observer&) {
                    const StudyLog log = read_log(project, name);
                    Json out = study_results_json(study_results(log.session));
                    out["log"] = name;
                    out["problems"] = Json::array();
                    for (const Problem& problem : log.problems) out["problems"].push_back(problem.message);
                    return out;
                  });
  });
  calls.add("study.export", [this, check_closed](const Request& request) {
    check_closed(request);
    answer_by_job(shared_.jobs, request, "", "",
                  [project = shared_.project, name = request.text("log")](const Observer&) {
                    const Json results = study_results_json(study_results(read_log(project, name).session));
                    Json out;
                    out["name"] = keep_results(project, name, results.dump(2) + '\n');
                    return out;
                  });
  });
}

void StudyPage::complain(std::exception_ptr error) {
  auto complaint = complaint_of(error, "The earlier answers are in the log.");
  if (!complaint) return;
  problem_ = std::move(complaint->problem);
  hint_ = std::move(complaint->hint);
  send_status();
}

// It has neither the sides of the textures nor the answers.
Json StudyPage::status() const {
  static constexpr std::array<const char*, 5> kPhases{"none", "reading", "paused", "running", "finished"};
  Json out;
  out["phase"] = kPhases.at(static_cast<std::size_t>(phase_));
  out["why"] = why_;
  out["log"] = log_name_;
  out["last_log"] = last_log_;
  out["problem"] = problem_;
  out["hint"] = hint_;
  out["session"] = Json();
  if (!session_) return out;
  const Study& study = session_->study();
  Json each;
  each["name"] = study.name;
  each["method"] = kStudyMethodNames.at(static_cast<std::size_t>(study.method));
  each["question"] = study.question;
  each["object"] = study.object;
  each["participant"] = session_->participant();
  each["device"] = study.presentation.device;
  each["trial"] = session_->trial() ? Json(session_->trial()->number) : Json();
  each["of"] = session_->planned() ? Json(*session_->planned()) : Json();
  each["answers"] = session_->answers().size();
  each["touching"] = host_.is_visited();
  each["ready"] = touch_since_ns_ != 0;
  each["touched"] = touched_;
  each["touched_a"] = is_touched(0);
  each["touched_b"] = is_touched(1);
  each["may_answer"] = is_whole_trial_touched();
  each["may_take_back"] = session_->can_take_back();
  out["session"] = std::move(each);
  return out;
}

// What was touched changes without a call.
void StudyPage::tick(std::int64_t) {
  if (session_ && host_.is_visited()) send_status();
}

void StudyPage::send_status() {
  Json now = status();
  if (now == sent_status_) return;
  sent_status_ = now;
  shared_.hub.broadcast("study", now);
}

std::unique_ptr<Page> make_study_page(Shared& shared, FeelHost& host) {
  return std::make_unique<StudyPage>(shared, host, shared.feel ? *shared.feel : FeelConfig());
}

}  // namespace asperity::studio

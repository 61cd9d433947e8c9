#include <fmt/format.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answer_keys.h"
#include "asperity/base/csv.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"
#include "asperity/device/device_registry.h"
#include "asperity/json/json.h"
#include "asperity/session/feel_settings.h"
#include "asperity/session/interrupt.h"
#include "asperity/session/study_scene.h"
#include "asperity/session/study_stimuli.h"
#include "asperity/session/utc_now.h"
#include "asperity/study/plan_trials.h"
#include "asperity/study/study_file.h"
#include "asperity/study/study_log.h"
#include "asperity/study/study_session.h"
#include "asperity/verdict/verdict_json.h"
#include "commands.h"
#include "trial_run.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook(20);  // between two looks at the keys, in which the force is kept
constexpr char kTakeBack = 'u', kPause = 'p', kQuit = 'q', kGoOn = ' ';

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

class StudyRunCommand : public Command {
 public:
  explicit StudyRunCommand(Parser& study)
      : Command(study, "run", "Ask a participant in the terminal, with a haptic device that renders the textures") {
    require(parser().add_option("STUDY", input_, "A study, NAME.study.json; or the log of a session to be continued"))
        ->type_name("FILE");
    parser()
        .add_option("--participant", participant_, "A code such as p01, not a name; needed for a new session")
        ->type_name("CODE");
    parser().add_option("--device", device_, "Instead of the study's; one of `asperity feel`")->type_name("NAME");
    parser().add_flag("--consented", consented_, "The participant has agreed to the consent text; else it is asked");
  }

  std::vector<ConfigField> fields() override { return feel_fields(settings_); }

  int run(const Observer&) override {
    reads(input_);
    input_.ends_with(kStudyLogEnding) ? open_old() : open_new();
    reads("");
    check_device();
    AnswerKeys keys;
    if (session_->answers().empty() && !agrees(keys)) {
      throw Error("the participant has not agreed; no session was begun");
    }
    return ask(keys);
  }

 private:
  std::string name_of(const std::string& file) const { return printable(file, 200); }

  Stimuli read_textures(const Study& study) const {
    const fs::path folder = fs::path(input_).parent_path();
    return read_stimuli(study, [&](const std::string& name) {
      const std::optional<fs::path> file = inner_file(folder.empty() ? fs::path(".") : folder, name);
      if (!file) throw Error(name_of(input_) + ": " + printable(name, 200) + " is not in the folder of the study");
      return *file;
    });
  }

  void open_new() {
    if (participant_.empty()) throw UsageError("--participant is missing: a code such as p01, not a name");
    Study study = parse_study_file(read_file(input_, kLargestStudy_bytes), name_of(input_));
    if (!device_.empty()) study.presentation.device = device_;
    check_participant(participant_);
    check_plan(study);
    stimuli_ = read_textures(study);
    const std::string stem = (fs::path(input_).parent_path() / (study.name + '_' + participant_)).string();
    int run = 1;
    log_name_ = stem + std::string(kStudyLogEnding);
    std::error_code error;
    while (fs::symlink_status(log_name_, error).type() != fs::file_type::not_found)
      log_name_ = stem + '_' + std::to_string(++run) + std::string(kStudyLogEnding);
    session_.emplace(std::move(study), participant_, run);
  }

  void create_log() {
    log_.emplace(StudyLogFile::create(log_name_, format_log_head(*session_, stimuli_.crc32)));
    log_->sync();
  }

  void open_old() {
    StudyLog read = parse_study_log(read_file(input_, kLargestStudyLog_bytes), name_of(input_));
    if (!participant_.empty() && participant_ != read.session.participant()) {
      throw UsageError("--participant: the log is of " + printable(read.session.participant()));
    }
    if (!device_.empty() && device_ != read.session.study().presentation.device) {
      throw UsageError("--device: this session was begun with " + printable(read.session.study().presentation.device));
    }
    if (!read.session.trial()) throw Error(name_of(input_) + ": all trials are answered");
    stimuli_ = read_textures(read.session.study());
    check_unchanged(read.session.study(), stimuli_, read.textures_crc32);
    log_.emplace(StudyLogFile::open(input_, read.whole_bytes));
    log_name_ = input_;
    version_ = read.version;
    before_s_ = read.since_begin_s;
    for (const Problem& problem : read.problems) print_error(problem.message);
    session_.emplace(std::move(read.session));
  }

  void check_device() const {
    const std::string& device = session_->study().presentation.device;
    if (device == "mouse") {
      throw UsageError(
          "the study's device is the mouse, which only the studio has: run asperity studio, or name a "
          "haptic device with --device");
    }
    const DeviceKind* kind = find_device_kind(device);
    if (kind == nullptr || kind->mover == DeviceMover::kPath) {
      throw UsageError("--device: '" + printable(device) +
                       "' cannot be used for a study; asperity feel --help lists them");
    }
    if (const auto needed = settings_.devices.missing(device)) {
      throw UsageError(fmt::format("--device {}: its {} is missing, --set {}={} or such", device, needed->what,
                                   needed->setting, needed->example));
    }
  }

  bool agrees(AnswerKeys& keys) const {
    const std::string& text = session_->study().consent;
    if (text.empty() || consented_) return true;
    print_error("the participant reads this before the first trial:\n" + text + "\n");
    print_error("y: I agree    n: I do not agree");
    for (;;) {
      const char key = keys.read(kLook, true);
      if (key == 'y' || key == 'Y') return true;
      if (key == 'n' || key == 'N' || key == AnswerKeys::kEnd) return false;
      if (interrupted()) throw Cancelled();
    }
  }

  int ask(AnswerKeys& keys) {
    TrialRun run(session_->study(), stimuli_, *session_->trial(), settings_);
    run.await_start(interrupt_flag());
    if (!log_ && !run.has_ended()) create_log();  // not before the device is there and runs
    for (const std::string& warning : run.warnings()) print_error(warning);
    begun_ = Clock::now();
    paused_ = false;
    announce();
    bool finished = false;
    while (!finished && !interrupted() && !run.has_ended()) {
      run.keep(!paused_);
      const char key = keys.read(kLook, paused_ || is_touched(run));
      if (key == 0) continue;
      if (key == kQuit || key == AnswerKeys::kEnd) break;
      finished = take(key, run);
    }
    run.keep(false);
    const bool ended_itself = run.has_ended();
    const Verdicts verdicts = run.finish();
    if (log_) report(finished, verdicts);
    if (interrupted()) return interrupt_exit_code();
    if (ended_itself && !log_) throw Error("the device has ended before the first trial; no log was made");
    if (ended_itself && !finished) throw Error("the device has ended; " + how_to_continue());
    return is_trustworthy(verdicts) ? kDone : kNotTrustworthy;
  }

  // Whether the session is over with this key.
  bool take(char key, TrialRun& run) {
    if (key == kPause || (paused_ && key == kGoOn)) {
      paused_ = key == kPause;
      tell(paused_ ? "Pause. Space: continue" : "");
      if (!paused_) announce();
      return false;
    }
    if (key == kTakeBack) {
      take_back(run);
      return false;
    }
    const std::optional<int> value = value_of(key);
    if (paused_ || !value) {
      tell(paused_ ? "Pause. Space: continue" : keys_text());
      return false;
    }
    if (!is_touched(run)) {
      tell(session_->trial()->right < 0 ? "Press on the texture first" : "Press on both textures first");
      return false;
    }
    return answer(*value, run);
  }

  bool answer(int value, TrialRun& run) {
    StudySession next = *session_;
    note(format_answer_row(next, next.give(value, run.felt_s(), since_begin_s(), run.touches()), date(), version_));
    session_.emplace(std::move(next));
    if (!session_->trial()) return true;
    run.present(*session_->trial());
    const int every = session_->study().break_every;
    paused_ = every > 0 && session_->answers().size() % static_cast<std::size_t>(every) == 0;
    paused_ ? tell("Break. Space: continue") : announce();
    return false;
  }

  void take_back(TrialRun& run) {
    if (!session_->can_take_back()) return tell("Only the last answer can be withdrawn, until the next one is given");
    StudySession next = *session_;
    next.take_back();
    note(format_taken_back_row(next.trial()->number, since_begin_s(), date(), version_));
    session_.emplace(std::move(next));
    run.present(*session_->trial());
    paused_ = false;
    announce();
  }

  // On the disk before the next trial is shown.
  void note(const std::string& row) {
    log_->append(row);
    log_->sync();
  }

  std::optional<int> value_of(char key) const {
    if (session_->study().method == StudyMethod::kRating) {
      const int rating = key - '0';
      return rating >= kLowestRating && rating <= kHighestRating ? std::optional(rating) : std::nullopt;
    }
    if (key == '1' || key == 'a' || key == 'A') return 0;
    if (key == '2' || key == 'b' || key == 'B') return 1;
    return std::nullopt;
  }

  bool is_touched(const TrialRun& run) const {
    const std::array<TileTouch, 2> touches = run.touches();
    const double least_s = session_->study().presentation.least_touch_s;
    for (std::size_t tile = 0; tile < tiles_of(session_->study()); ++tile) {
      if (!(touches.at(tile).touch_s > 0.0 && touches.at(tile).touch_s >= least_s)) return false;
    }
    return true;
  }

  std::string keys_text() const {
    const std::string answers = session_->study().method == StudyMethod::kRating
                                    ? fmt::format("{} to {}: rating", kLowestRating, kHighestRating)
                                    : std::string("1: A (left)    2: B (right)");
    return answers + "    u: withdraw the last answer    p: pause    q: end";
  }

  void announce() const {
    const std::optional<int> planned = session_->planned();
    tell(fmt::format("\nTrial {}{}: {}\n{}", session_->trial()->number,
                     planned ? " of " + std::to_string(*planned) : std::string(),
                     printable(session_->study().question, 500), keys_text()));
  }

  void tell(const std::string& text) const {
    if (!text.empty()) say(text + "\n");
  }

  std::string how_to_continue() const {
    return "asperity study run " + printable(log_name_, 200) + " continues the session";
  }

  void report(bool finished, const Verdicts& verdicts) const {
    Json out = Json::object();
    out["log"] = log_name_;
    out["answers"] = session_->answers().size();
    out["finished"] = finished;
    out["trustworthy"] = is_trustworthy(verdicts);
    out["verdicts"] = verdicts_json(verdicts);
    print_json(out.dump_repaired(2));
    tell(fmt::format("\n{} answers in {}", session_->answers().size(), printable(log_name_, 200)));
    tell(finished ? "all trials are answered; asperity study summarize has the results" : how_to_continue());
    for (const Verdict& verdict : verdicts) {
      if (verdict.severity == Severity::kInvalid || !quiet()) print_error(verdict_line(verdict));
    }
  }

  double since_begin_s() const { return before_s_ + seconds_since(begun_); }
  std::string date() const { return session_->study().dates ? utc_now() : std::string(); }

  std::string input_, participant_, device_;
  bool consented_ = false;
  FeelSettings settings_;
  Stimuli stimuli_;
  std::optional<StudySession> session_;
  std::optional<StudyLogFile> log_;
  std::string log_name_;
  int version_ = kStudyLogVersion;
  double before_s_ = 0.0;
  Clock::time_point begun_;
  bool paused_ = false;
};

}  // namespace

std::unique_ptr<Command> make_study_run(Parser& study) { return std::make_unique<StudyRunCommand>(study); }

}  // namespace asperity::app

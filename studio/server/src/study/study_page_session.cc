#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/host_clock.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/session/study_stimuli.h"
#include "asperity/session/utc_now.h"
#include "asperity/studio/calls.h"
#include "asperity/study/plan_trials.h"
#include "asperity/study/study_file.h"
#include "study/study_advice.h"
#include "study/study_page.h"
#include "study/trial_scene.h"

// The session: its beginning and end, its trials, what is rendered in them.

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRunningFile = ".asperity-study.json";  // names the log that is being written
constexpr std::uint64_t kLargestRunningFile = 4096;

}  // namespace

// The result of the job that opens a log.
struct StudyPage::Opening {
  explicit Opening(Project in) : project(std::move(in)) {}

  Project project;
  std::string name;  // of a log to be continued; empty: a new one
  Study study;       // of a new one
  std::string participant;
  std::optional<StudySession> session;
  std::shared_ptr<StudyLogFile> log;
  Stimuli stimuli;
  double before_s = 0.0;
  int version = kStudyLogVersion;
  std::string problem;

  void open_new() {
    check_plan(study);
    stimuli = read_textures(study);
    const std::string stem = study.name + '_' + participant;
    int run = 1;
    name = stem + std::string(kStudyLogEnding);
    while (is_taken(project.folder() / name)) {
      name = stem + '_' + std::to_string(++run) + std::string(kStudyLogEnding);
    }
    session.emplace(study, participant, run);
    log = std::make_shared<StudyLogFile>(
        StudyLogFile::create(project.writable(name), format_log_head(*session, stimuli.crc32)));
  }

  // Opens the log, and names it in `file` as the open one; a new one is not left behind without that.
  void open(const fs::path& file) {
    const bool is_new = name.empty();
    advised([&] { is_new ? open_new() : open_old(); });
    try {
      log->sync();
      Json running;
      running["log"] = name;
      write_file(file, running.dump() + '\n');
    } catch (...) {
      std::error_code error;
      if (is_new) fs::remove(project.folder() / name, error);
      throw;
    }
  }

  Stimuli read_textures(const Study& of) const {
    return read_stimuli(of, [this](const std::string& stimulus) { return project.existing(stimulus); });
  }

  void open_old() {
    if (!name.ends_with(kStudyLogEnding)) {
      throw Advice(printable(name, 200) + ": is not the log of a study",
                   "Choose a file that ends with " + std::string(kStudyLogEnding) + ".");
    }
    const fs::path file = project.existing(name);
    name = file.lexically_relative(project.folder()).generic_string();
    StudyLog read = parse_study_log(read_file(file, kLargestStudyLog_bytes), name);
    if (!read.session.trial()) throw Advice(name + ": all trials are answered", "Open its results.");
    stimuli = read_textures(read.session.study());
    check_unchanged(read.session.study(), stimuli, read.textures_crc32);
    log = std::make_shared<StudyLogFile>(StudyLogFile::open(file, read.whole_bytes));
    before_s = read.since_begin_s;
    version = read.version;
    if (!read.problems.empty()) problem = read.problems.front().message;
    session = std::move(read.session);
  }
};

void StudyPage::bind_session(Calls& calls) {
  calls.add("study.begin", [this](const Request& request) { begin(request); });
  calls.add("study.continue", [this](const Request& request) { go_on(request.text("log"), &request); });
  calls.add("study.open", [this](const Request& request) {
    if (!session_) throw Advice("no session is open", "Begin a session.");
    request.answer(make_trial_block(session_->study()));
  });
  calls.add("study.touch", [this](const Request& request) { touch(request); });
  calls.add("study.answer", [this](const Request& request) { answer(request); });
  calls.add("study.take_back", [this](const Request& request) { take_back(request); });
  calls.add("study.pause", [this](const Request& request) {
    if (phase_ == Phase::kRunning) pause("pause");
    request.done();
  });
  calls.add("study.resume", [this](const Request& request) {
    if (phase_ == Phase::kPaused) {
      phase_ = Phase::kRunning;
      why_.clear();
    }
    request.done();
    send_status();
  });
  calls.add("study.end", [this](const Request& request) {
    end();
    request.done();
  });
}

// A session that was open when the studio ended is opened again, and waits.
void StudyPage::start() {
  const fs::path file = shared_.project.folder() / kRunningFile;
  std::error_code error;
  if (fs::symlink_status(file, error).type() == fs::file_type::not_found) return;
  try {
    const Json running = parse_study_text(read_file(file, kLargestRunningFile), kRunningFile);
    if (!running.is_object() || !running.contains("log") || !running["log"].is_string()) {
      throw Error(std::string(kRunningFile) + ": does not name a log");
    }
    go_on(running["log"].get<std::string>(), nullptr);
  } catch (const std::exception&) {
    complain(std::current_exception());
  }
}

void StudyPage::begin(const Request& request) {
  if (phase_ != Phase::kNone) throw Advice("a session is open already", "End it first.");
  auto opening = std::make_shared<Opening>(shared_.project);
  opening->study = study();
  opening->participant = shared_.document.section("study").value("participant", "");
  if (!opening->study.consent.empty() && !(request.has("consented") && request.flag("consented"))) {
    throw Advice("the participant has not agreed", "Show the consent text, and begin when the participant agrees.");
  }
  if (opening->participant.empty()) {
    throw Advice("the participant has no code", "Enter a code such as p01, not a name.");
  }
  advised([&] { check_plan(opening->study); });
  open(opening, &request, "");
}

void StudyPage::go_on(const std::string& log, const Request* request) {
  if (phase_ != Phase::kNone) throw Advice("a session is open already", "End it first.");
  auto opening = std::make_shared<Opening>(shared_.project);
  opening->name = log;
  open(opening, request, request ? "pause" : "restart");
}

void StudyPage::open(const std::shared_ptr<Opening>& opening, const Request* request, std::string_view why) {
  phase_ = Phase::kReading;
  problem_.clear();
  hint_.clear();
  std::optional<Request> asked;
  if (request) asked = *request;
  shared_.jobs.start_in(
      "study", "Reading the study's textures", "",
      [opening, file = shared_.project.folder() / kRunningFile](const Observer& observer) {
        observer.update("reading", 0.0);
        opening->open(file);
      },
      [this, opening, asked, why = std::string(why)](std::exception_ptr error) {
        phase_ = Phase::kNone;
        if (error) {
          if (!asked) return complain(error);
          send_status();
          try {
            std::rethrow_exception(error);
          } catch (const std::exception& fault) {
            return asked->refuse(fault);
          }
        }
        session_ = std::move(opening->session);
        stimuli_ = std::make_shared<const std::vector<Texture>>(std::move(opening->stimuli.textures));
        log_ = std::move(opening->log);
        log_name_ = opening->name;
        log_version_ = opening->version;
        before_s_ = opening->before_s;
        opened_ns_ = host_now_ns();
        problem_ = opening->problem;
        hint_ = problem_.empty() ? "" : "The trial is repeated.";
        phase_ = why.empty() ? Phase::kRunning : Phase::kPaused;
        why_ = why;
        present();
        if (asked) asked->answer(status());
      });
  send_status();
}

// The next trial, or the end.
void StudyPage::present() {
  ++presented_;
  touch_since_ns_ = 0;
  touched_s_ = 0.0;
  touched_ = false;
  touches_.reset();
  if (session_->trial()) {
    touches_ = std::make_shared<TileTouches>(tile_of_triangle(session_->study()),
                                             session_->study().presentation.least_force_N);
  }
  if (!session_->trial()) {
    phase_ = Phase::kFinished;
    why_.clear();
    host_.leave();
  } else if (phase_ == Phase::kRunning && host_.is_visited()) {
    host_.change_visit(visit());
  }
  send_status();
}

FeelVisit StudyPage::visit() const {
  FeelVisit out;
  out.key = presented_;
  out.setup = study_setup(session_->study(), start_);
  out.touches = touches_;
  out.make = [study = session_->study(), stimuli = stimuli_, trial = *session_->trial()](FeelSetup&) {
    return make_trial_scene(study, *stimuli, trial);
  };
  return out;
}

void StudyPage::touch(const Request& request) {
  if (!request.flag("on")) {
    if (touch_asked_) std::exchange(touch_asked_, std::nullopt)->done();
    host_.leave();
    return request.done();
  }
  if (phase_ != Phase::kRunning) throw Advice("no trial is open", "Begin a session, or end the break.");
  if (host_.is_visited()) return request.done();
  if (touch_asked_) touch_asked_->done();
  touch_asked_ = request;
  start_touch();
}

// The one before may still be leaving: a moment after an answer, a break or a stop.
void StudyPage::start_touch() {
  if (!touch_asked_ || host_.is_leaving()) return;
  const Request request = *std::exchange(touch_asked_, std::nullopt);
  if (phase_ != Phase::kRunning) {
    return request.refuse(Advice("no trial is open any more", "Begin a session, or end the break."));
  }
  toucher_ = request.client();
  try {
    host_.visit(request, visit());
  } catch (const std::exception& fault) {
    request.refuse(fault);
  }
}

// What can be rendered has changed.
void StudyPage::follow_touch() {
  const std::uint64_t felt = host_.visited_key();
  // Another trial has come while the device was being opened.
  if (phase_ == Phase::kRunning && felt != 0 && felt != presented_) return host_.change_visit(visit());
  const bool now = phase_ == Phase::kRunning && felt == presented_;
  const std::int64_t now_ns = host_now_ns();
  if (now && touch_since_ns_ == 0) {
    touch_since_ns_ = now_ns;
    touched_ = true;
  } else if (!now && touch_since_ns_ != 0) {
    touched_s_ = response_s(now_ns);
    touch_since_ns_ = 0;
  }
  send_status();
  start_touch();
}

std::array<TileTouch, 2> StudyPage::touches() const {
  return touches_ ? touches_->touches() : std::array<TileTouch, 2>();
}

bool StudyPage::is_touched(std::size_t tile) const {
  const double touch_s = touches().at(tile).touch_s;
  return touch_s > 0.0 && touch_s >= session_->study().presentation.least_touch_s;
}

bool StudyPage::is_whole_trial_touched() const {
  if (!session_->trial() || !is_touched(0)) return false;
  return session_->trial()->right < 0 || is_touched(1);
}

double StudyPage::response_s(std::int64_t now_ns) const {
  return touched_s_ + (touch_since_ns_ == 0 ? 0.0 : 1e-9 * static_cast<double>(now_ns - touch_since_ns_));
}

double StudyPage::since_begin_s() const { return before_s_ + 1e-9 * static_cast<double>(host_now_ns() - opened_ns_); }

std::string StudyPage::date() const { return session_->study().dates ? utc_now() : std::string(); }

void StudyPage::answer(const Request& request) {
  if (phase_ != Phase::kRunning) throw Advice("no trial is open", "Begin a session, or end the break.");
  if (request.integer("trial") != session_->trial()->number) {
    throw Advice("this trial is answered already", "Another one is shown now.");
  }
  if (!touched_)
    throw Advice("nothing was touched in this trial", "Press Space and touch the surface before you answer.");
  if (!is_whole_trial_touched()) {
    throw Advice(session_->trial()->right < 0 ? "the texture was not touched with force"
                                              : "not both textures were touched with force",
                 "Press on the surface until its mark is set, then answer.");
  }
  StudySession next = *session_;
  const std::int64_t value = request.integer("answer");
  if (value < 0 || value > kHighestRating) throw Error(std::to_string(value) + " is not an answer to this trial");
  note_row(format_answer_row(next,
                             next.give(static_cast<int>(value), response_s(host_now_ns()), since_begin_s(), touches()),
                             date(), log_version_));
  session_ = std::move(next);
  const int every = session_->study().break_every;
  const bool rest = every > 0 && session_->answers().size() % static_cast<std::size_t>(every) == 0;
  if (rest && session_->trial()) pause("break");
  present();
  request.done();
}

void StudyPage::take_back(const Request& request) {
  if (!session_ || !session_->can_take_back()) {
    throw Advice("no answer can be withdrawn", "Only the last answer can be withdrawn, until the next one is given.");
  }
  StudySession next = *session_;
  next.take_back();
  note_row(format_taken_back_row(next.trial()->number, since_begin_s(), date(), log_version_));
  session_ = std::move(next);
  if (phase_ == Phase::kFinished || why_ == "break") {
    phase_ = Phase::kRunning;
    why_.clear();
  }
  present();
  request.done();
}

// To the system at once: what was confirmed outlives the program. To the disk next to the page.
void StudyPage::note_row(const std::string& row) {
  log_->append(row);
  shared_.jobs.start_storing(
      "study", "", "the last answers of the study may be lost", [log = log_](const Observer&) { log->sync(); },
      [this](std::exception_ptr error) {
        if (error) complain(error);
      });
}

void StudyPage::pause(std::string_view why) {
  phase_ = Phase::kPaused;
  why_ = why;
  host_.leave();
  follow_touch();
}

void StudyPage::end() {
  if (!session_) return;
  host_.leave();
  phase_ = Phase::kNone;
  why_.clear();
  problem_.clear();
  hint_.clear();
  session_.reset();
  stimuli_.reset();
  log_.reset();
  last_log_ = std::exchange(log_name_, {});
  std::error_code error;
  fs::remove(shared_.project.folder() / kRunningFile, error);
  send_status();
}

void StudyPage::client_left(ClientId client) {
  if (session_ && client == toucher_) host_.leave();
}

}  // namespace asperity::studio

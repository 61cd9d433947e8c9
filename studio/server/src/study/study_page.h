#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/scene/scene.h"
#include "asperity/studio/feel_config.h"
#include "asperity/studio/page.h"
#include "asperity/study/study_log.h"
#include "asperity/study/study_session.h"
#include "feel/feel_host.h"

namespace asperity::studio {

// The Study page (docs/studio-study.md): one session at a time, whose trials are rendered by the loop of the Feel page.
class StudyPage : public Page {
 public:
  // `host` outlives the page's last call.
  StudyPage(Shared& shared, FeelHost& host, FeelConfig start);

  void bind(Document& document, Calls& calls) override;
  void start() override;
  void client_left(ClientId client) override;
  void tick(std::int64_t now_ns) override;

 private:
  enum class Phase { kNone, kReading, kPaused, kRunning, kFinished };
  struct Opening;

  void bind_setup(Calls& calls);
  void bind_logs(Calls& calls);
  void bind_session(Calls& calls);

  Study study() const;
  void begin(const Request& request);
  void go_on(const std::string& log, const Request* request);
  void open(const std::shared_ptr<Opening>& opening, const Request* request, std::string_view why);
  void touch(const Request& request);
  void start_touch();
  void answer(const Request& request);
  void take_back(const Request& request);
  void pause(std::string_view why);
  void end();

  void present();
  void note_row(const std::string& row);
  void follow_touch();
  FeelVisit visit() const;
  std::array<TileTouch, 2> touches() const;
  bool is_touched(std::size_t tile) const;
  bool is_whole_trial_touched() const;
  double response_s(std::int64_t now_ns) const;
  double since_begin_s() const;
  std::string date() const;
  void complain(std::exception_ptr error);
  void send_status();
  Json status() const;

  Shared& shared_;
  FeelHost& host_;
  FeelConfig start_;

  Phase phase_ = Phase::kNone;
  std::string why_;  // it is paused: "pause", "break", "restart"
  std::optional<StudySession> session_;
  std::shared_ptr<const std::vector<Texture>> stimuli_;
  std::shared_ptr<StudyLogFile> log_;
  std::string log_name_, last_log_;
  int log_version_ = kStudyLogVersion;
  double before_s_ = 0.0;  // of the session, when it was opened
  std::int64_t opened_ns_ = 0;

  std::uint64_t presented_ = 0;         // key of the trial that is presented
  std::optional<Request> touch_asked_;  // waits for the end of the touch before
  ClientId toucher_ = 0;                // who started the touch
  std::int64_t touch_since_ns_ = 0;     // 0: it cannot be touched now
  double touched_s_ = 0.0;              // before that
  bool touched_ = false;
  std::shared_ptr<TileTouches> touches_;  // of the trial that is presented
  std::string problem_, hint_;
  Json sent_status_;
};

std::unique_ptr<Page> make_study_page(Shared& shared, FeelHost& host);

}  // namespace asperity::studio

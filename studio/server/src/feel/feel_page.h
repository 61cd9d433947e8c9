#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "asperity/studio/page.h"
#include "feel/feel_host.h"
#include "feel/feel_run.h"
#include "feel/loaded_scene.h"

namespace asperity::studio {

struct FinishedLogs;

// The Feel page (docs/studio-feel.md): a scene, a device, and the loop between them.
class FeelPage : public Page, public FeelHost {
 public:
  // `start` is what the command line and the user's config say; a browser changes of it only settable_fields(), and
  // lowers the largest force.
  explicit FeelPage(Shared& shared, FeelConfig start = {});
  ~FeelPage() override;

  void bind(Document& document, Calls& calls) override;
  void start() override;
  void tick(std::int64_t now_ns) override;
  void edited(const Edit& edit) override;
  void check_edit(ClientId client, const Edit& edit) const override;
  void pointed(ClientId client, const Pointer& pointer) override;
  void stop() override;

  void visit(const Request& request, FeelVisit visit) override;
  void change_visit(FeelVisit visit) override;
  void leave() override;
  bool is_visited() const override { return visited_ && !is_leaving(); }
  bool is_leaving() const override;
  std::uint64_t visited_key() const override;
  void on_visit(std::function<void()> changed) override { visit_changed_ = std::move(changed); }

 private:
  enum class State { kIdle, kOpening, kRunning, kStopping };
  struct Opening;

  FeelChoices choices() const;
  double largest_force_N() const;
  void load();
  void loaded(std::shared_ptr<const LoadedScene> world);
  void begin(const Request& request);
  void check_start(const DeviceKind& kind, const Request& request) const;
  void open_in_job(const Request& request, const std::shared_ptr<Opening>& opening, std::string_view title,
                   std::function<void(const Observer&)> open);
  void end_run();
  void opened(Opening& opening, std::exception_ptr error);
  void swap_model();
  void ended();
  void set_log(const Request& request);
  void collect_logs();
  void store_log(std::shared_ptr<FeelLog> log);
  void log_is_whole(const std::string& fault);
  bool belongs_to(ClientId client) const { return run_owner_ == client; }
  void keep_flight_record(ServoResult& servo);
  void take(const Request& request);
  void permit(std::int64_t now_ns);
  void complain(std::exception_ptr error);
  void send_status();
  Json status() const;
  Json fields() const;

  Shared& shared_;
  FeelConfig start_;
  State state_ = State::kIdle;
  bool stop_asked_ = false;  // while opening

  std::shared_ptr<const LoadedScene> world_;  // the newest that is whole
  std::uint64_t revision_ = 0;                // of the choices
  std::uint64_t worlds_ = 0;                  // made so far
  bool loading_ = false;
  std::string problem_, hint_;

  std::unique_ptr<FeelRun> run_;
  std::uint64_t run_number_ = 0;
  OpenedFeel running_;  // without device and model
  std::string device_model_;
  std::vector<std::string> warnings_;
  ClientId run_owner_ = 0;  // whose run it is: only that one's lease commands its force
  std::string log_name_;
  std::vector<Request> log_requests_;
  std::shared_ptr<FinishedLogs> finished_logs_;
  Json last_run_;

  bool visited_ = false;             // the scene that is rendered, or being opened, is a visitor's
  std::uint64_t visit_key_ = 0;      // of the scene under the hand; 0: being changed
  bool permitted_ = false;           // the force, at the last look
  std::uint64_t visit_changes_ = 0;  // so far: the newest one counts
  std::int64_t held_until_ns_ = 0;   // no force before, between two things of a visitor
  std::function<void()> visit_changed_;
  Json sent_status_;
};

std::unique_ptr<FeelPage> make_feel_page(Shared& shared);

}  // namespace asperity::studio

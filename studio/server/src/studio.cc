#include "asperity/studio/studio.h"

#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "asperity/acquire/host_clock.h"
#include "asperity/studio/calls.h"
#include "inbox.h"
#include "pages.h"

namespace asperity::studio {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kTick = std::chrono::microseconds(33'333);
constexpr auto kSaveAfter = std::chrono::seconds(1);
constexpr const char* kDocumentFile = ".asperity-studio.json";

// The thread on which pages live: hears the browsers, ticks, keeps the document.
class Studio {
 public:
  explicit Studio(const StudioConfig& config)
      : config_(config),
        project_(config.folder),
        document_(project_.folder() / kDocumentFile),
        server_(WebServer::start(config.server, events())),
        jobs_(std::make_unique<Jobs>(*server_, [this](Inbox::Work work) { inbox_.post(std::move(work)); })),
        shared_{*server_,
                project_,
                document_,
                *jobs_,
                lease_,
                is_this_machine_only(config.server.host) || config.remote_force,
                [this](Inbox::Work work) { inbox_.post(std::move(work)); },
                config.feel},
        pages_(make_pages(shared_, config.open)) {
    for (const auto& page : pages_) page->bind(document_, calls_);
    jobs_->bind(calls_);
    document_.load();
    document_.on_change([this](const Edit& edit) {
      for (const auto& page : pages_) page->edited(edit);
    });
    for (const auto& page : pages_) page->start();
  }

  ~Studio() {
    for (const auto& page : pages_) page->stop();
    jobs_.reset();
    server_->stop();
    save();
  }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  std::string address() const { return server_->address(); }

  void run(const std::atomic<bool>& stop) {
    auto next = Clock::now();
    auto saved = next;
    while (!stop.load()) {
      for (const Inbox::Work& work : inbox_.wait(next)) work();
      const auto now = Clock::now();
      if (now < next) continue;
      // Ticks that were missed are not caught up with.
      next = now - next > kTick ? now + kTick : next + kTick;
      const std::int64_t now_ns = host_now_ns();
      for (const auto& page : pages_) page->tick(now_ns);
      if (now - saved >= kSaveAfter) {
        saved = now;
        save();
      }
    }
  }

 private:
  WebServerEvents events() {
    WebServerEvents out;
    out.joined = [](ClientId) {};
    out.left = [this](ClientId client) {
      inbox_.post([this, client] {
        for (const auto& page : pages_) page->client_left(client);
      });
    };
    out.message = [this](ClientId client, Message message) {
      inbox_.post([this, client, message = std::move(message)] { hear(client, message); });
    };
    return out;
  }

  void hear(ClientId client, const Message& message) {
    if (const auto* call = std::get_if<Call>(&message)) {
      calls_.dispatch(Request(*server_, client, *call));
    } else {
      for (const auto& page : pages_) page->pointed(client, std::get<Pointer>(message));
    }
  }

  // A full disk must not end the studio: it is said once, and tried again.
  void save() {
    try {
      document_.save();
      save_failed_ = false;
    } catch (const Error& error) {
      if (save_failed_) return;
      save_failed_ = true;
      Json note;
      note["message"] = std::string("The studio's state cannot be saved: ") + error.what();
      note["hint"] =
          "Free some space, or see whether the folder may be written. Nothing is lost as long as the studio runs.";
      server_->broadcast("note", note);
    }
  }

  StudioConfig config_;
  Inbox inbox_;
  Project project_;
  Document document_;
  ForceLease lease_;
  Calls calls_;
  std::unique_ptr<WebServer> server_;
  std::unique_ptr<Jobs> jobs_;
  Shared shared_;
  std::vector<std::unique_ptr<Page>> pages_;
  bool save_failed_ = false;
};

}  // namespace

void run_studio(const StudioConfig& config, const std::function<void(const std::string& address)>& started,
                const std::atomic<bool>& stop) {
  Studio studio(config);
  started(studio.address());
  studio.run(stop);
}

}  // namespace asperity::studio

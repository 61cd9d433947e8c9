#include "scan/scan_page.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "asperity/base/host_clock.h"
#include "asperity/base/text.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/utc_now.h"
#include "config_fields.h"
#include "scan/bench_source.h"
#include "scan/hardware_source.h"
#include "scan/open_scan.h"
#include "scan/refine_scan.h"
#include "scan/replay_source.h"
#include "scan/rescued_scan_calls.h"
#include "scan/scan_choices.h"
#include "scan/scan_devices.h"
#include "scan/scan_session.h"
#include "temporary_folder.h"

namespace asperity::studio {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kClosedStatePeriod_ns = 500'000'000;

std::unique_ptr<ScanSource> open_source(const ScanChoices& choices, const ScanConfig& config,
                                        const std::optional<fs::path>& recording, const Observer& observer) {
  switch (choices.source) {
    case SourceKind::kBench:
      return make_bench_source(config.bench, observer);
    case SourceKind::kHardware:
      return make_hardware_source(choices.hardware, choices.world);
    case SourceKind::kReplay:
      break;
  }
  Recording read = read_recording(recording.value(), {}, observer);
  if (!choices.segment.empty()) {
    const Segment segment = find_segment(read, choices.segment);
    read = cut_recording(read, segment.start_ns, segment.end_ns);
  }
  return make_replay_source(std::move(read));
}

class ScanPage : public Page {
 public:
  explicit ScanPage(Shared& shared) : shared_(shared) {}

  void bind(Document& document, Calls& calls) override {
    document.add_section(
        "scan", first_scan_section(), [](const Json& section) { read_scan_choices(section); },
        [](Json& section) {
          ScanConfig config;
          use_present_names(section, "settings", scan_fields(config));
        });
    calls.add("scan.sources", [](const Request& request) { request.answer(devices_json()); });
    calls.add("scan.fields", [this](const Request& request) {
      ScanConfig now = make_scan_config(choices().settings), first = make_scan_config({});
      request.answer(fields_json(scan_fields(now), scan_fields(first)));
    });
    calls.add("scan.status", [this](const Request& request) {
      Json out;
      out["open"] = session_ != nullptr;
      out["opening"] = busy_;
      out["refined"] = refined_.has_value();
      request.answer(out);
    });
    calls.add("scan.open", [this](const Request& request) { open(request); });
    calls.add("scan.close", [this](const Request& request) { close(request); });
    calls.add("scan.start", [this](const Request& request) {
      session().start("");
      request.done();
    });
    calls.add("scan.stop", [this](const Request& request) {
      session().stop();
      request.done();
    });
    calls.add("scan.segment", [this](const Request& request) {
      const std::string name = request.text("name");
      constexpr std::size_t kLongest = 100;
      if (name.size() > kLongest) throw Advice("the segment's name is too long", "Use at most 100 letters.");
      session().next_segment(name);
      request.done();
    });
    calls.add("scan.discard", [this](const Request& request) {
      session().discard();
      request.done();
    });
    calls.add("scan.rescan", [this](const Request& request) {
      session().rescan();
      request.done();
    });
    calls.add("scan.restore", [this](const Request& request) {
      session().restore();
      request.done();
    });
    rescued_.bind(calls);
    calls.add("scan.profile", [this](const Request& request) { request.answer(session().profile()); });
    calls.add("scan.path", [this](const Request& request) { request.answer(session().path()); });
    calls.add("scan.refined", [this](const Request& request) {
      if (!refined_) throw Advice("no scan is finished yet", "Scan, and press Stop.");
      request.answer(*refined_);
    });
  }

  void tick(std::int64_t now_ns) override {
    if (session_ || now_ns - stated_ns_ < kClosedStatePeriod_ns) return;
    stated_ns_ = now_ns;
    if (!shared_.hub.has_subscribers("scan.state")) return;
    BlockWriter state("scan.state");
    state.head()["topic"] = "scan.state";
    state.head()["open"] = false;
    state.head()["opening"] = busy_;
    shared_.hub.publish("scan.state", state.take(), Delivery::kLatest);
  }

  void edited(const Edit& edit) override {
    if (edit.path != "/scan" && !edit.path.starts_with("/scan/")) return;
    const ScanChoices now = choices();
    if (session_ && now.automatic != automatic_) session_->set_automatic(now.automatic);
    automatic_ = now.automatic;
    if (now.settings == settings_) return;
    settings_ = now.settings;
    if (session_) session_->tune(make_scan_config(settings_));
    refine();
  }

  void start() override {
    settings_ = choices().settings;
    automatic_ = choices().automatic;
    shared_.jobs.start_in(
        "project", "", "", [](const Observer&) { remove_stale_temporary_folders(); }, nullptr);
    rescued_.start();
  }

  void stop() override {
    if (session_) finish(std::exchange(session_, nullptr), std::make_shared<bool>(), nullptr);
  }

 private:
  // What was discarded last, and what had been made of it.
  struct DiscardedScan {
    Segment segment;
    std::shared_ptr<ScanRefiner> refiner;
    std::optional<BlockWriter> refined;
    std::map<std::string, std::string> refined_by;
  };

  ScanChoices choices() const { return read_scan_choices(shared_.document.section("scan")); }

  ScanSession& session() {
    if (!session_) throw Advice("no source is open", "Choose a source and press Open.");
    return *session_;
  }

  void open(const Request& request) {
    if (busy_) throw Advice("a source is being opened or closed", "Wait until that is done.");
    if (session_) throw Advice("a source is open already", "Close it first.");
    ScanChoices chosen = choices();
    chosen.hardware = resolve_hardware(chosen.hardware, shared_.project);
    std::optional<fs::path> recording;
    if (chosen.source == SourceKind::kHardware && !shared_.may_command_forces) {
      throw Advice("this studio does not open sensors of this machine",
                   "Other machines can reach this studio. Start it with --remote-force to allow sensors.");
    }
    if (chosen.source == SourceKind::kReplay) {
      if (chosen.recording.empty())
        throw Advice("no recording is chosen", "Choose a recording of the project's folder.");
      recording = shared_.project.existing(chosen.recording);
    }
    ScanSetup setup;
    setup.config = make_scan_config(chosen.settings);
    setup.automatic = chosen.automatic;
    setup.name = shared_.project.free_name(chosen.name);
    setup.folder = shared_.project.writable(setup.name);
    setup.object = chosen.object;
    setup.created = utc_now();
    busy_ = true;
    auto opened = std::make_shared<std::unique_ptr<ScanSession>>();
    auto waiting = std::make_shared<ScanSetup>(std::move(setup));
    shared_.jobs.start_in(
        "scan", "Opening the source", "",
        [this, chosen, recording, waiting, opened](const Observer& observer) {
          waiting->source = open_source(chosen, waiting->config, recording, observer);
          ScanEvents told = events(waiting->name);
          const std::string name = waiting->name;
          *opened = std::make_unique<ScanSession>(shared_.hub, std::move(*waiting), std::move(told));
          note_open_scan(shared_.project.folder(), name);
        },
        [this, request, opened](std::exception_ptr error) {
          busy_ = false;
          if (error) return refuse(request, error);
          session_ = std::move(*opened);
          session_->set_automatic(automatic_);
          Json out;
          out["recording"] = session_->name();
          request.answer(out);
        });
  }

  void close(const Request& request) {
    if (busy_) throw Advice("a source is being opened or closed", "Wait until that is done.");
    if (!session_) return request.answer(Json{{"recording", nullptr}});
    busy_ = true;
    auto ending = std::exchange(session_, nullptr);
    auto kept = std::make_shared<bool>(false);
    finish(ending, kept, [this, request, ending, kept](std::exception_ptr error) {
      busy_ = false;
      if (error && is_cancelled(error)) session_ = ending;  // it did not begin; the recording continues
      if (error) return refuse(request, error);
      discarded_.reset();
      request.answer(Json{{"recording", *kept ? Json(ending->name()) : Json()}});
    });
  }

  // `kept` is false where it holds nothing.
  void finish(const std::shared_ptr<ScanSession>& ending, const std::shared_ptr<bool>& kept, Jobs::Done done) {
    shared_.jobs.start_storing(
        "scan", "Finishing the recording", incomplete(ending->name()),
        [ending, kept, folder = shared_.project.folder()](const Observer&) {
          *kept = ending->finish();
          forget_open_scan(folder);
        },
        std::move(done));
  }

  static std::string incomplete(const std::string& name) {
    return "the recording " + printable(name, 200) + " is incomplete";
  }

  static void refuse(const Request& request, const std::exception_ptr& error) {
    try {
      std::rethrow_exception(error);
    } catch (const std::exception& fault) {
      request.refuse(fault);
    }
  }

  static bool is_cancelled(const std::exception_ptr& error) {
    try {
      std::rethrow_exception(error);
    } catch (const Cancelled&) {
      return true;
    } catch (...) {
      return false;
    }
  }

  ScanEvents events(const std::string& name) {
    ScanEvents out;
    out.lost = [this, name](const std::string& why) { shared_.report_loss(incomplete(name) + ": " + why); };
    out.finished = [this](FinishedScan scan) {
      auto handed = std::make_shared<FinishedScan>(std::move(scan));
      shared_.post([this, handed] {
        const Segment segment = handed->segment;
        const bool is_back = discarded_ && discarded_->segment.start_ns == segment.start_ns &&
                             discarded_->segment.end_ns == segment.end_ns;
        if (is_back) return bring_back(segment, std::move(handed->live));
        finished_ = segment;
        refiner_ = std::make_shared<ScanRefiner>(std::move(*handed));
        refine();
      });
    };
    out.retuned = [this](LiveHeights live) {
      auto handed = std::make_shared<LiveHeights>(std::move(live));
      shared_.post([this, handed] { refine(std::move(*handed)); });
    };
    out.discarded = [this] {
      shared_.post([this] {
        if (refiner_) discarded_ = DiscardedScan{finished_, refiner_, refined_, refined_by_};
        forget();
      });
    };
    out.forgotten = [this] { shared_.post([this] { forget(); }); };
    return out;
  }

  void forget() {
    refiner_.reset();
    show_refined(BlockWriter("scan.refined"));
    refined_.reset();
  }

  // What was discarded last is as it was; it may have another name.
  void bring_back(const Segment& segment, LiveHeights live) {
    DiscardedScan back = *std::exchange(discarded_, std::nullopt);
    refiner_ = std::move(back.refiner);
    finished_ = segment;
    if (!back.refined || back.refined_by != settings_) return refine(std::move(live));
    back.refined->head()["segment"] = printable(segment.name, 100);
    refined_by_ = std::move(back.refined_by);
    show_refined(std::move(*back.refined));
  }

  // The finished scan in full, with the newest settings and against the newest causal profile.
  void refine(std::optional<LiveHeights> live = std::nullopt) {
    if (!refiner_) return;
    auto refined = std::make_shared<std::optional<BlockWriter>>();
    shared_.jobs.start(
        "Refining the profile", "scan.refine",
        [refiner = refiner_, segment = finished_.name, process = make_scan_config(settings_).process, live,
         refined](const Observer& observer) {
          refiner->rename(segment);
          if (live) refiner->set_live(*live);
          refined->emplace(refiner->refine(process, observer));
        },
        [this, refiner = refiner_, by = settings_, refined](std::exception_ptr error) {
          if (refiner != refiner_) return;
          const auto show = [this, &by](BlockWriter block) {
            refined_by_ = by;
            show_refined(std::move(block));
          };
          if (!error) return show(std::move(**refined));
          try {
            std::rethrow_exception(error);
          } catch (const Cancelled&) {
            // A newer setting has replaced it.
          } catch (const std::exception& fault) {
            BlockWriter failed("scan.refined");
            failed.head()["failure"] = fault.what();
            show(std::move(failed));
          }
        });
  }

  void show_refined(BlockWriter block) {
    refined_ = block;
    block.head()["topic"] = "scan.refined";
    shared_.hub.publish("scan.refined", block.take(), Delivery::kLatest);
  }

  Shared& shared_;
  std::shared_ptr<ScanSession> session_;
  bool busy_ = false;  // opening or closing
  bool automatic_ = false;
  std::map<std::string, std::string> settings_;
  Segment finished_;                      // the last finished scan
  std::shared_ptr<ScanRefiner> refiner_;  // of it; used by the jobs' thread
  std::optional<BlockWriter> refined_;
  std::map<std::string, std::string> refined_by_;  // settings
  std::optional<DiscardedScan> discarded_;
  RescuedScanCalls rescued_{shared_};
  std::int64_t stated_ns_ = 0;
};

}  // namespace

std::unique_ptr<Page> make_scan_page(Shared& shared) { return std::make_unique<ScanPage>(shared); }

}  // namespace asperity::studio

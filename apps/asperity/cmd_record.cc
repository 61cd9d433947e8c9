#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/camera/frame_writer.h"
#include "asperity/recorder/recorder.h"
#include "asperity/session/interrupt.h"
#include "asperity/session/record_input.h"
#include "asperity/session/utc_now.h"
#include "commands.h"
#include "option_units.h"
#include "record_report.h"
#include "record_status.h"
#include "recording_evidence.h"
#include "terminal_keys.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

struct RecordSettings {
  RecorderConfig recorder;
  TrackConfig track;
  JudgeRecordingConfig verdict;

  template <class V>
  void visit(V& v) {
    v.group("recorder", recorder);
    v.group("track", track);
    v.group("verdict", verdict);
  }
};

class RecordCommand : public Command {
 public:
  explicit RecordCommand(Parser& root) : Command(root, "record", "Record a probe and its pose while a hand scans") {
    settings_.recorder.start_at_once = true;
    require(parser().add_option("--probe", input_.probe,
                                "serial:/dev/ttyUSB0[@BAUD], usb:VID:PID[:SERIAL], udp:PORT or file:CAPTURE"))
        ->type_name("ADDRESS");
    parser()
        .add_option("--protocol", input_.protocol,
                    "open (the default), or what (the WHaT, the probe of Andrews's thesis)")
        ->type_name("NAME");
    parser()
        .add_option("--capture", input_.capture,
                    "Also write the bytes of the probe to a new file, for --probe file:CAPTURE")
        ->type_name("FILE");
    parser()
        .add_option("--camera", input_.camera,
                    "v4l2:/dev/video0[?rate=120&…], y4m:PATH, images:FOLDER or video:FILE (by ffmpeg)")
        ->type_name("ADDRESS");
    parser()
        .add_option("--markers", input_.markers, "Tags on the probe; default: those of the calibration")
        ->type_name("markers.json");
    parser()
        .add_option("--poses", input_.poses,
                    "Lines t_ns,px_m,… of another tracker instead of a camera: udp:PORT, pipe:PATH or file:PATH")
        ->type_name("ADDRESS");
    parser()
        .add_option("--body", input_.bodies,
                    "A further body of --poses, whose lines begin with its name: object makes the scan relative to it")
        ->type_name("NAME");
    parser().add_option("--world", info_.world, "The poses' world: camera (the default) or z_up")->type_name("NAME");
    parser()
        .add_option("--calibration", input_.calibration, "Calibration of the probe, the camera and the tracker")
        ->type_name("calibration.json");
    parser().add_flag("--uncalibrated", input_.uncalibrated,
                      "Record without a calibration, to calibrate from the recording");
    parser().add_flag("--auto", auto_, "Store data only while the probe is in contact");
    parser().add_option("--duration", duration_, "Stop after this time; default: at q or Ctrl-C")->type_name("TIME");
    parser().add_option("--object", info_.object, "Name of the scanned object")->type_name("NAME");
    parser().add_flag("--frames", frames_, "Keep the camera's images as PNG in frames/");
    require(parser().add_option("-o,--output", output_, "The recording's folder, which must not exist yet"))
        ->type_name("REC");
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (auto_) settings_.recorder.mode = StoreMode::kAuto;
    if (!duration_.empty()) duration_s_ = duration_option_s("--duration", duration_, 86'400.0);
  }

  int run(const Observer&) override {
    check_sensors();
    if (info_.world != "camera" && info_.world != "z_up")
      throw UsageError("--world: '" + printable(info_.world) + "' is neither camera nor z_up");
    if (!is_utf8(info_.object)) throw UsageError("--object: is not UTF-8");
    if (frames_ && input_.camera.empty()) throw UsageError("--frames needs --camera");
    if (info_.world == "z_up") info_.gravity_world_mps2 = {0.0, 0.0, -info_.gravity_world_mps2.norm()};
    if (!input_.bodies.empty() && input_.poses.empty()) throw UsageError("--body needs --poses");
    info_.created = utc_now();
    const std::optional<Calibration> calibration = read_record_calibration(input_);

    info_.bodies = record_bodies(input_, calibration);
    std::optional<FrameWriter> kept;
    if (frames_) kept.emplace(fs::path(output_) / "frames");
    const auto on_frame = [&](const CameraFrame& frame) {
      if (kept && storing_) kept->push(frame);
    };
    const FinishHold hold;
    RecordOutcome outcome;
    outcome.recording = output_;
    {
      RecorderSensors sensors = make_record_sensors(input_, calibration, settings_.track, on_frame);
      if (kept) {
        sensors.failure_besides = [&kept, capture = sensors.failure_besides] {
          const std::string failure = kept->counts().failure;
          return failure.empty() && capture ? capture() : failure;
        };
      }
      Recorder recorder(output_, info_, calibration, std::move(sensors), settings_.recorder);
      outcome.end = watch(recorder);
      storing_ = false;
      outcome.recorder = recorder.finish();
    }
    if (kept) {
      kept->finish();
      outcome.frames = kept->counts();
      if (!outcome.frames.failure.empty()) throw Error(outcome.frames.failure);
    }
    return report(outcome, calibration.has_value());
  }

 private:
  void check_sensors() const {
    if (input_.probe.empty()) throw UsageError("--probe: an address is needed");
    if (!input_.camera.empty() && !input_.poses.empty()) throw UsageError("--camera and --poses exclude each other");
    if (input_.calibration.empty() && !input_.uncalibrated)
      throw UsageError("--calibration is missing; --uncalibrated records without one, to calibrate from the recording");
    if (!input_.calibration.empty() && input_.uncalibrated)
      throw UsageError("--calibration and --uncalibrated exclude each other");
    if (!input_.camera.empty() && input_.uncalibrated)
      throw UsageError("--camera needs --calibration, the calibration of the camera, to find poses");
    if (!input_.markers.empty() && input_.camera.empty()) throw UsageError("--markers needs --camera");
    try {
      check_record_addresses(input_);
    } catch (const Error& error) {
      throw UsageError(error.what());
    }
  }

  // Shows how it goes and hears the keys, until there is a reason to end.
  std::string watch(Recorder& recorder) {
    using namespace std::chrono_literals;
    TerminalKeys keys(!quiet());
    RecordStatus status(quiet() || json(), keys.active());
    for (;;) {
      const RecorderSnapshot now = recorder.snapshot();
      storing_ = now.storing;
      status.show(now);
      if (interrupted()) return "signal";
      if (!now.failure.empty()) return "failure";
      if (duration_s_ > 0.0 && now.running_s >= duration_s_) return "duration";
      const bool poses_ended = now.poses.state == SensorState::kEnded || now.poses.state == SensorState::kAbsent;
      if (now.probe.state == SensorState::kEnded && poses_ended) return "inputs_ended";
      const char key = keys.read(50ms);
      if (key == 'q') return "key";
      if (key == ' ' && now.storing) recorder.stop_segment();
      if (key == ' ' && !now.storing) recorder.start_segment();
      if (key == 'd') recorder.discard_segment();
      if (key == 'r') recorder.rescan_segment();
    }
  }

  int report(RecordOutcome& outcome, bool calibrated) {
    const bool by_contact = settings_.recorder.mode == StoreMode::kAuto;
    outcome.verdicts = judge_recording(recording_evidence(outcome.recorder, outcome.frames, by_contact, calibrated),
                                       settings_.verdict);
    print_json(record_json(outcome, fields()));
    say(record_text(outcome));
    for (const Verdict& verdict : outcome.verdicts) {
      if (verdict.severity == Severity::kInvalid || !quiet()) print_error(verdict_line(verdict));
    }
    return is_trustworthy(outcome.verdicts) ? kDone : kNotTrustworthy;
  }

  RecordInput input_;
  RecordingInfo info_;
  std::string duration_, output_;
  double duration_s_ = 0.0;
  bool auto_ = false, frames_ = false;
  std::atomic<bool> storing_{false};
  RecordSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_record(Parser& root) { return std::make_unique<RecordCommand>(root); }

}  // namespace asperity::app

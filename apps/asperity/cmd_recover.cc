#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/base/version.h"
#include "asperity/recording/recover_recording.h"
#include "commands.h"

namespace asperity::app {

namespace {

Json stream_json(const RecoveredStream& stream) {
  Json out = losses_json(stream);
  out["file"] = stream.file;
  out["found"] = stream.found;
  out["checked"] = stream.checked;
  out["messages"] = stream.messages;
  return out;
}

std::string stream_text(const RecoveredStream& stream, bool keep_changed) {
  std::string out = fmt::format("{}: {} rows saved", stream.file, stream.rows);
  const std::size_t lost = stream.unreadable_rows + (keep_changed ? 0 : stream.changed_rows);
  out += lost > 0 ? fmt::format(", {} left out", lost) : ", none left out";
  if (stream.rows_missing) out += ", others are missing";
  if (keep_changed && stream.changed_rows > 0) out += fmt::format(", {} of them changed", stream.changed_rows);
  out += stream.checked ? " (checked by checksums.txt)\n" : " (no checksums to check by)\n";
  for (const std::string& message : stream.messages) out += "  " + printable(message, 300) + "\n";
  return out;
}

class RecoverCommand : public Command {
 public:
  explicit RecoverCommand(Parser& root)
      : Command(root, "recover", "Save the readable data of a damaged recording to a new one") {
    require(parser().add_option("REC", recording_, "The damaged recording's folder, which is only read"));
    parser()
        .add_option("--like", like_, "A recording of the same probe and tracker, for unreadable JSON files")
        ->type_name("REC");
    parser().add_flag("--keep-changed", options_.keep_changed, "Also keep rows whose checksum differs");
    require(parser().add_option("-o,--output", output_, "The new recording's folder, which must not exist yet"))
        ->type_name("NEW");
  }

  std::vector<ConfigField> fields() override { return {}; }

  int run(const Observer& observer) override {
    options_.like = like_;
    OutputFolder folder(output_, [](const std::filesystem::path&) { return false; });
    const RecoveredRecording result = recover_recording(recording_, folder.path(), options_, {}, observer);
    commit_output(folder, output_);
    report(result);
    return kDone;
  }

 private:
  void report(const RecoveredRecording& result) {
    Json out = Json::object();
    out["format"] = "asperity-recovered";
    out["version"] = 1;
    out["recording"] = output_;
    out["lost_nothing"] = result.lost_nothing();
    out["streams"] = {stream_json(result.probe), stream_json(result.tracker)};
    for (const RecoveredStream& body : result.bodies) out["streams"].push_back(stream_json(body));
    out["taken_from_another"] = result.taken_from_like;
    out["asperity"] = kVersion;
    print_json(out.dump_repaired(2));
    std::string text =
        stream_text(result.probe, options_.keep_changed) + stream_text(result.tracker, options_.keep_changed);
    for (const RecoveredStream& body : result.bodies) text += stream_text(body, options_.keep_changed);
    for (const std::string& file : result.taken_from_like)
      text += fmt::format("{}: could not be read; taken from {}\n", file, printable(like_, 200));
    text += fmt::format("saved in {}{}\n", printable(output_, 200), result.lost_nothing() ? "; nothing is lost" : "");
    say(text);
  }

  std::string recording_, like_, output_;
  RecoverOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_recover(Parser& root) { return std::make_unique<RecoverCommand>(root); }

}  // namespace asperity::app

#include <memory>
#include <string>
#include <vector>

#include "asperity/recording/inspect_recording.h"
#include "asperity/recording/read_recording.h"
#include "commands.h"

namespace asperity::app {

namespace {

class InspectCommand : public Command {
 public:
  explicit InspectCommand(Parser& root)
      : Command(root, "inspect", "Rates, gaps, losses, saturation and noise of a recording, and its faults") {
    require(parser().add_option("REC", recording_, "The recording's folder"));
  }

  std::vector<ConfigField> fields() override { return list_fields("inspect", config_); }

  int run(const Observer& observer) override {
    const Recording recording = read_recording(recording_, {}, observer);
    observer.update("inspecting", 0.5);
    const Inspection inspection = inspect_recording(recording, config_);
    print_json(inspection_json(inspection).dump(2));
    say(inspection_text(inspection));
    return kDone;
  }

 private:
  std::string recording_;
  InspectConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_inspect(Parser& root) { return std::make_unique<InspectCommand>(root); }

}  // namespace asperity::app

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/read_recording.h"
#include "commands.h"
#include "result_summary.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

// The last part of a path, that of "rec/" and "." included.
std::string folder_name(const std::string& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.filename().string();
}

class ProcessCommand : public Command {
 public:
  explicit ProcessCommand(CLI::App& root)
      : Command(root, "process", "From recordings to surface profiles, roughness and haptic textures") {
    require(parser().add_option("REC", recordings_, "Recordings; several give OUT/NAME/ each"));
    require(parser().add_option("-o,--output", output_, "Folder of the results"))->type_name("OUT");
    parser().add_option("--method", method_, "fused (ours, the default) or thesis (the baseline)")->type_name("NAME");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  void apply_options() override {
    if (method_.empty()) return;
    try {
      set_field(fields(), "method", method_);
    } catch (const Error& error) {
      throw UsageError(std::string("--") + error.what());
    }
  }

  int run(const Observer& observer) override {
    std::set<std::string> names;
    for (const std::string& recording : recordings_) {
      if (recording.empty()) throw UsageError("REC: a recording's folder has no name");
      if (!names.insert(folder_name(recording)).second) {
        throw UsageError("two recordings are called '" + printable(folder_name(recording)) + "'");
      }
    }
    OutputFolder folder(output_, is_result_folder);
    bool trustworthy = true;
    std::string text;
    for (const std::string& path : recordings_) {
      const std::string name = folder_name(path);
      const fs::path place = recordings_.size() == 1 ? folder.path() : folder.path() / name;
      fs::create_directories(place);
      trustworthy &= process(path, name, place, observer, text);
    }
    observer.update("writing", 1.0);
    folder.commit();
    print_json(recordings_.size() == 1 ? results_.front().second : joined_results());
    say(text + "results in " + printable(output_, 200) + "\n");
    for (const std::string& why : distrust_) complain(why);
    return trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  bool process(const std::string& path, const std::string& name, const fs::path& place, const Observer& observer,
               std::string& text) {
    observer.update("reading", 0.0);
    const Recording recording = read_recording(path);
    ProcessResult result;
    try {
      result = process_recording(recording, config_, observer);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(printable(path, 200) + ": " + error.what());
    }
    observer.update("writing", 0.0);
    write_result(place, result, recording, name);
    results_.emplace_back(name, format_result(result, recording, name));
    text += printable(name, 200) + "\n" + result_summary(result);
    if (!result.trustworthy) distrust_.push_back(printable(path, 200) + ": not to be trusted: " + result.verdict);
    return result.trustworthy;
  }

  std::string joined_results() const {
    nlohmann::ordered_json out;
    out["format"] = "asperity-results";
    out["version"] = 1;
    for (const auto& [name, json] : results_) {
      out["results"][is_utf8(name) ? name : printable(name, 200)] = nlohmann::ordered_json::parse(json);
    }
    return out.dump(2);
  }

  std::vector<std::string> recordings_;
  std::string output_;
  std::string method_;
  ProcessConfig config_;
  std::vector<std::pair<std::string, std::string>> results_;
  std::vector<std::string> distrust_;
};

}  // namespace

std::unique_ptr<Command> make_process(CLI::App& root) { return std::make_unique<ProcessCommand>(root); }

}  // namespace asperity::app

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/parse_json.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/read_recording.h"
#include "asperity/studio/measured_block.h"
#include "asperity/studio/write_report.h"
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
  explicit ProcessCommand(Parser& root)
      : Command(root, "process", "From recordings to surface profiles, roughness and haptic textures") {
    require(parser().add_option("REC", recordings_,
                                "Recordings; several give OUT/NAME/ each, and several segments with gaps between them "
                                "OUT/SEGMENT/ or OUT/NAME/SEGMENT/ each"));
    require(parser().add_option("-o,--output", output_, "Folder of the results"))->type_name("OUT");
    parser().add_option("--segment", segment_, "Only this segment of each recording")->type_name("NAME");
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
    std::string text;
    for (const std::string& path : recordings_) {
      const std::string name = folder_name(path);
      process_pieces(path, name, recordings_.size() == 1 ? folder.path() : folder.path() / name, observer, text);
    }
    observer.update("writing", 1.0);
    if (!alone_) studio::write_report(folder.path(), items_);
    folder.commit();
    print_json(alone_ ? results_.front().second : joined_results());
    say(text + "results in " + printable(output_, 200) + "\n");
    for (const std::string& why : distrust_) complain(why);
    return distrust_.empty() ? kDone : kNotTrustworthy;
  }

 private:
  // The whole recording, or its segments each for itself where they stand apart.
  void process_pieces(const std::string& path, const std::string& name, const fs::path& place, const Observer& observer,
                      std::string& text) {
    observer.update("reading", 0.0);
    const Recording recording = read_recording(path);
    const std::vector<Segment> pieces = chosen_segments(path, recording);
    alone_ = recordings_.size() == 1 && pieces.size() < 2;
    if (pieces.empty()) {
      process(path, name, recording, place, observer, text);
    } else if (pieces.size() == 1) {
      process(path, name, cut_recording(recording, pieces[0].start_ns, pieces[0].end_ns), place, observer, text);
    } else {
      process_each(path, name, recording, pieces, place, observer, text);
    }
  }

  std::vector<Segment> chosen_segments(const std::string& path, const Recording& recording) const {
    if (segment_.empty()) return separate_segments(recording);
    try {
      return {find_segment(recording, segment_)};
    } catch (const Error& error) {
      throw Error(printable(path, 200) + ": " + error.what());
    }
  }

  // A touch too short for a profile is left out; that all are is an error.
  void process_each(const std::string& path, const std::string& name, const Recording& recording,
                    const std::vector<Segment>& pieces, const fs::path& place, const Observer& observer,
                    std::string& text) {
    const std::vector<std::string> folders = segment_folders(pieces);
    const std::size_t before = results_.size();
    std::string first_fault;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const Recording piece = cut_recording(recording, pieces[i].start_ns, pieces[i].end_ns);
      const std::string whole_name = recordings_.size() == 1 ? folders[i] : name + "/" + folders[i];
      try {
        process(path + "/" + folders[i], whole_name, piece, place / folders[i], observer, text);
      } catch (const Cancelled&) {
        throw;
      } catch (const Error& error) {
        if (first_fault.empty()) first_fault = error.what();
        distrust_.push_back(std::string(error.what()) + "; left out");
      }
    }
    if (results_.size() == before) throw Error(first_fault);
  }

  void process(const std::string& path, const std::string& name, const Recording& recording, const fs::path& place,
               const Observer& observer, std::string& text) {
    ProcessResult result;
    try {
      result = process_recording(recording, config_, observer);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      throw Error(printable(path, 200) + ": " + error.what());
    }
    observer.update("writing", 0.0);
    fs::create_directories(place);
    write_result(place, result, recording, name);
    items_.push_back({name, studio::measured_block(result, recording, name).take()});
    studio::write_report(place, {items_.back()});
    results_.emplace_back(name, format_result(result, recording, name));
    text += printable(name, 200) + "\n" + result_summary(result);
    if (!result.trustworthy) distrust_.push_back(printable(path, 200) + ": not to be trusted: " + result.verdict);
  }

  std::string joined_results() const {
    Json out;
    out["format"] = "asperity-results";
    out["version"] = 1;
    for (const auto& [name, json] : results_) {
      out["results"][is_utf8(name) ? name : printable(name, 200)] = parse_json(json);
    }
    return out.dump(2);
  }

  std::vector<std::string> recordings_;
  std::string output_;
  std::string method_;
  std::string segment_;
  bool alone_ = true;  // one result, not several by name
  ProcessConfig config_;
  std::vector<std::pair<std::string, std::string>> results_;
  std::vector<studio::ReportItem> items_;
  std::vector<std::string> distrust_;
};

}  // namespace

std::unique_ptr<Command> make_process(Parser& root) { return std::make_unique<ProcessCommand>(root); }

}  // namespace asperity::app

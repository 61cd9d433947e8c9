#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/in_background.h"
#include "asperity/base/interval_text.h"
#include "asperity/base/output.h"
#include "asperity/base/rounded_text.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/process_recording.h"
#include "asperity/pipeline/process_result.h"
#include "asperity/pipeline/result_json.h"
#include "asperity/pipeline/write_result.h"
#include "asperity/profile/stiffness_of_compliance.h"
#include "asperity/recording/cut_recording.h"
#include "asperity/recording/fingerprint.h"
#include "asperity/recording/read_recording.h"
#include "asperity/session/register_input.h"
#include "asperity/session/rendered_input.h"
#include "asperity/studio/measured_block.h"
#include "asperity/studio/write_report.h"
#include "commands.h"

namespace asperity::app {

namespace {

// "verdict  valid", or a line for each verdict.
std::string verdict_lines(const Verdicts& verdicts) {
  if (verdicts.empty()) return "  verdict     valid\n";
  std::string out;
  for (const Verdict& verdict : verdicts)
    out += (out.empty() ? "  verdict     " : "              ") + verdict_line(verdict) + "\n";
  return out;
}

// A value and its standard error to so many decimals; words where one of them is missing.
std::string with_error(double value, double error, int decimals) {
  if (!std::isfinite(value)) return "not determined";
  if (!std::isfinite(error)) return fmt::format("{:.{}f}", value, decimals);
  // Of a value that is much better known than that, more decimals: "0.05 ± 0.0" states nothing.
  if (error > 0.0 && error < 0.5 * std::pow(10.0, -decimals)) return interval_text(value, error, 1);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

std::string friction_lines(const FrictionEstimate& f) {
  if (f.verdict.empty()) return "";
  std::string out;
  if (f.determined) {
    out = fmt::format("  friction    {:.3f} ± {:.3f} sliding at {:.1f} mm/s under {:.2g} N\n", f.coefficient,
                      f.standard_error, 1e3 * f.speed_mps, f.force_N);
  } else {
    out = "  friction    " + f.verdict + "\n";
  }
  if (f.stribeck) {
    out += fmt::format("              {:.3f} static, {:.3f} sliding, Stribeck speed {:.1f} mm/s\n", f.stribeck->at_rest,
                       f.stribeck->sliding, 1e3 * f.stribeck->speed_mps);
  }
  if (f.sticks > 0) {
    out += fmt::format("              stuck {} times, {:.1f} % of the contact", f.sticks, 100.0 * f.stuck_share);
    out += std::isfinite(f.breakaway)
               ? fmt::format(", breaking away at {:.3f} ± {:.3f}\n", f.breakaway, f.breakaway_stderr)
               : "\n";
  }
  if (std::isfinite(f.static_ratio)) {
    out += "              sticking over sliding " + with_error(f.static_ratio, f.static_ratio_stderr, 2) + "\n";
  }
  return out;
}

// The lines that the path is over more than once.
std::string repeated_lines(const ProcessResult& result) {
  std::string out;
  for (const RepeatedLine& line : result.lines) {
    const MergedProfile& merged = line.merged;
    out += fmt::format("  repeated    {} passes over one line, {}\n", merged.passes.size(),
                       line.laid ? fmt::format("{} merged", merged.used) : "not merged: " + line.reason);
    if (!std::isfinite(merged.noise_ratio)) continue;
    out += fmt::format(
        "              noise of a pass by their differences: {:.2g} times the power stated, 95 %: {:.2g} to {:.2g}\n",
        merged.noise_ratio, merged.noise_ratio_low, merged.noise_ratio_high);
  }
  return out;
}

// A few lines for a person on what was measured.
std::string result_summary(const ProcessResult& result) {
  const std::string_view shape = result.base.shape == PathShape::kDoublyCurved
                                     ? "doubly curved surface"
                                     : kPathShapeNames.at(static_cast<std::size_t>(result.base.shape));
  const double length_stderr_mm = 1e3 * result.noise.length_stderr_m;
  std::string out = fmt::format("  scan path   {} mm on a {}, {:.0f} % with heights, {:.1f} mm/s\n",
                                with_error(1e3 * result.base.length_m, length_stderr_mm, 2), shape,
                                100.0 * result.coverage.covered, result.speed.mean_mps * 1e3);
  if (std::isfinite(result.noise.snr)) {
    out += fmt::format("  noise       {} µm RMS in the texture, signal to noise {} (power)\n",
                       interval_text(1e6 * result.noise.noise_rms_m, 1e6 * result.noise.noise_rms_stderr_m, 1, 2),
                       rounded_text(result.noise.snr));
  }
  out += repeated_lines(result);
  if (result.roughness) {
    const RoughnessResult& r = *result.roughness;
    const auto um = [&](double RoughnessParameters::*value) {
      return with_error(1e6 * (r.*value), 1e6 * (r.standard_error.*value), 1) + " µm";
    };
    if (std::isfinite(r.Rq_m)) {
      out += fmt::format("  roughness   Ra {}, Rq {}, Rz {}, RSm {}\n", um(&RoughnessParameters::Ra_m),
                         um(&RoughnessParameters::Rq_m), um(&RoughnessParameters::Rz_m),
                         std::isfinite(r.RSm_m) ? with_error(1e3 * r.RSm_m, 1e3 * r.standard_error.RSm_m, 3) + " mm"
                                                : std::string("not determined"));
    } else {
      out += fmt::format("  roughness   not determined: the texture is not above its noise; Rq is at most {:.2g} µm\n",
                         1e6 * result.noise.at_most_m);
    }
  }
  if (result.periodicity.periodic) {
    const Periodicity& p = result.periodicity;
    out += fmt::format("  pattern     pitch {} mm, depth {} µm over {} periods\n",
                       with_error(p.pitch_m * 1e3, p.pitch_stderr_m * 1e3, 3),
                       with_error(p.depth_m * 1e6, p.depth_stderr_m * 1e6, 0), p.periods);
  }
  if (result.stiffness.measured) {
    const StiffnessEstimate& s = result.stiffness;
    out += fmt::format("  stiffness   {:.3g} N/mm, 95 %: {:.3g} to {:.3g}\n", s.stiffness_N_per_mm,
                       s.lower_bound_N_per_mm, s.upper_bound_N_per_mm);
  } else if (!result.stiffness.verdict.empty()) {
    out += "  stiffness   " + result.stiffness.verdict + "\n";
  }
  if (result.compliance.determined) {
    const Compliance& c = result.compliance;
    out += fmt::format(
        "  compliance  k_c {:.3f} ± {:.3f}, 95 %: {:.3f} to {:.3f}, from {} windows of {:.2g} to {:.2g} N\n", c.k_c,
        c.k_c_stderr, c.k_c_low, c.k_c_high, c.windows.size(), c.lightest_N, c.firmest_N);
    if (const auto k = stiffness_of_compliance(c); k && std::isfinite(k->high_N_per_mm) && !result.stiffness.measured) {
      out += fmt::format("              by the chart {:.2g} N/mm, 95 %: {:.2g} to {:.2g}\n", k->stiffness_N_per_mm,
                         k->low_N_per_mm, k->high_N_per_mm);
    }
  } else if (!result.compliance.verdict.empty()) {
    out += "  compliance  " + result.compliance.verdict + "\n";
  }
  out += friction_lines(result.friction);
  if (result.fit) {
    out += fmt::format("  texture     {:.4g} mm, {} harmonics, {:.1f} µm RMS, model error {:.1f} µm\n",
                       result.fit->texture.length_mm, result.fit->texture.a_m.size(), result.fit->rms_height_m * 1e6,
                       result.fit->rms_error_m * 1e6);
  }
  if (result.accuracy) {
    const Accuracy& a = *result.accuracy;
    out += fmt::format("  truth       position {:.0f} µm RMS (raw tracker {:.0f} µm)", a.position_rms_m * 1e6,
                       a.tracker_rms_m * 1e6);
    if (a.profile && !std::isfinite(a.profile->correlation)) {
      out += ", profile: nothing to compare";
    } else if (a.profile) {
      out += fmt::format(", profile: correlation {:.3f}, gain {:.3f}, {:.1f} µm RMS, length {:+.2f} %",
                         a.profile->correlation, a.profile->gain, a.profile->rms_um, a.profile->length_error_percent);
    }
    out += "\n";
  }
  out += verdict_lines(result.verdicts);
  for (const Problem& problem : result.problems) out += "  note        " + problem.message + "\n";
  return out;
}

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
      : Command(root, "process", "Measure surface profiles, roughness and haptic textures from recordings") {
    require(parser().add_option("REC", recordings_,
                                "Recordings; several give OUT/NAME/ each, and several segments with gaps between them "
                                "OUT/SEGMENT/ or OUT/NAME/SEGMENT/ each"));
    require(parser().add_option("-o,--output", output_, "Folder of the results"))->type_name("OUT");
    parser().add_option("--segment", segment_, "Process only this segment of each recording")->type_name("NAME");
    parser()
        .add_option("--method", method_, "The first is the default: " + ProcessMethods::describe())
        ->type_name("NAME")
        ->suggest(kMethodNames);
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
      if (recording.empty()) throw UsageError("REC: the name of a recording's folder is empty");
      if (!names.insert(folder_name(recording)).second) {
        throw UsageError("two recordings are called '" + printable(folder_name(recording)) + "'");
      }
    }
    OutputFolder folder(output_, naming_added(is_result_folder));
    std::string text;
    for (const std::string& path : recordings_) {
      const std::string name = folder_name(path);
      process_pieces(path, name, recordings_.size() == 1 ? folder.path() : folder.path() / name, observer, text);
    }
    reads("");
    observer.update("writing", 1.0);
    if (!alone_) studio::write_report(folder.path(), items_);
    commit_output(folder, output_);
    print_json(alone_ ? results_.front().second.dump_repaired(2) : joined_results());
    say(text + "results in " + printable(output_, 200) + "\n");
    for (const std::string& why : reasons_) print_error(why);
    return valid_ ? kDone : kNotTrustworthy;
  }

 private:
  // The whole recording, or its segments each for itself where they stand apart.
  void process_pieces(const std::string& path, const std::string& name, const fs::path& place, const Observer& observer,
                      std::string& text) {
    observer.update("reading", 0.0);
    reads(path);
    const Recording recording = read_recording(path, {}, observer);
    // Reads all files once more, while the processor has the recording.
    checksum_ = in_background([path] { return recording_checksum(path); }).share();
    source_ = {name, {}, fingerprint_of(recording)};
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
        reasons_.push_back(std::string(error.what()) + "; left out");
        valid_ = false;
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
    source_.checksum = checksum_.get();  // an unreadable file is an error without a texture, too
    if (result.texture) note_sources(*result.texture, {source_});
    const Json json = result_json(result, recording, name);
    write_result(place, result, json);
    items_.push_back({name, studio::measured_block(json, result, recording).take()});
    studio::write_report(place, {items_.back()});
    results_.emplace_back(name, json);
    text += printable(name, 200) + "\n" + result_summary(result);
    for (const Verdict& verdict : result.verdicts) {
      if (verdict.severity == Severity::kNote) continue;
      reasons_.push_back(printable(path, 200) + ": " + verdict_line(verdict));
    }
    valid_ &= result.trustworthy;
  }

  std::string joined_results() const {
    Json out;
    out["format"] = "asperity-results";
    out["version"] = 1;
    for (const auto& [name, result] : results_) {
      out["results"][is_utf8(name) ? name : printable(name, 200)] = result;
    }
    return out.dump_repaired(2);
  }

  std::vector<std::string> recordings_;
  std::string output_;
  std::string method_;
  std::string segment_;
  bool alone_ = true;    // one result, not several by name
  StrokeSource source_;  // the recording that is processed
  std::shared_future<std::string> checksum_;
  ProcessConfig config_;
  std::vector<std::pair<std::string, Json>> results_;
  std::vector<studio::ReportItem> items_;
  std::vector<std::string> reasons_;  // what is invalid, limited or left out
  bool valid_ = true;
};

}  // namespace

std::unique_ptr<Command> make_process(Parser& root) { return std::make_unique<ProcessCommand>(root); }

}  // namespace asperity::app

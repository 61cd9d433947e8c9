#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/config_json.h"
#include "asperity/session/our_file.h"
#include "commands.h"
#include "option_units.h"
#include "roughness_files.h"
#include "roughness_of.h"

namespace asperity::app {

namespace {

class RoughnessCommand : public Command {
 public:
  explicit RoughnessCommand(Parser& root)
      : Command(root, "roughness", "Roughness of a profile (ISO 21920-2) or an areal map (ISO 25178-2)") {
    require(parser().add_option(
        "FILE", files_,
        "Any number of: profile.csv or a result's folder, heights one a line, x_mm,y_mm,z_um, a GSF, SDF, SUR or X3P "
        "file, or a stroke's "
        "folder (import --stroke: its spectrum), or an areal *.texture.json, or - for standard input"));
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for a file without positions")
        ->type_name("LENGTH");
    parser().add_option("--lambda-s", lambda_s_, "Shorter waves are removed (S-filter of a map)")->type_name("LENGTH");
    parser()
        .add_option("--lambda-c", lambda_c_, "Longer waves are removed from R and belong to W (L-filter of a map)")
        ->type_name("LENGTH");
    parser().add_option("--lambda-f", lambda_f_, "Longer waves are removed from W")->type_name("LENGTH");
    parser()
        .add_option("--filter", filter_,
                    "gaussian (ISO 16610-21, of maps 16610-61), or robust (16610-31, 16610-71) for deep pits")
        ->type_name("NAME")
        ->suggest(kProfileFilterNames);
    parser()
        .add_option("--noise", noise_,
                    "Standard deviation of a map's heights, as the instrument states it; gives intervals")
        ->type_name("LENGTH");
    parser().add_option("--table", table_, "Write all values, one row per file")->type_name("FILE.csv");
    parser().add_option("--report", report_, "Write values and plots as one page")->type_name("FILE.html");
    parser()
        .add_option("--class", class_, "Setting class: Sc1 to Sc5 (λc 0.08, 0.25, 0.8, 2.5, 8 mm), or auto")
        ->type_name("CLASS")
        ->suggest(kFiltersNames);
  }

  std::vector<ConfigField> fields() override { return list_fields("", settings_); }

  void apply_options() override {
    if (!spacing_.empty()) settings_.input.spacing_m = length_option_m("--spacing", spacing_);
    if (!lambda_s_.empty())
      settings_.profile.lambda_s_mm = settings_.areal.lambda_s_mm = 1e3 * length_option_m("--lambda-s", lambda_s_);
    if (!lambda_c_.empty())
      settings_.profile.lambda_c_mm = settings_.areal.lambda_c_mm = 1e3 * length_option_m("--lambda-c", lambda_c_);
    if (!lambda_f_.empty()) settings_.profile.lambda_f_mm = 1e3 * length_option_m("--lambda-f", lambda_f_);
    if (!noise_.empty()) settings_.noise.rms_um = 1e6 * length_option_m("--noise", noise_);
    set_choice("--filter", "roughness.filter", filter_);
    set_choice("--filter", "areal.filter", filter_);
    set_choice("--class", "setting_class", class_);
  }

  int run(const Observer& observer) override {
    if (std::count(files_.begin(), files_.end(), "-") > 1) throw UsageError("standard input (-) can be read only once");
    std::error_code unknown;
    if (!table_.empty() && !report_.empty() &&
        std::filesystem::weakly_canonical(table_, unknown) == std::filesystem::weakly_canonical(report_, unknown)) {
      throw UsageError("--table and --report name the same file");
    }
    if (!table_.empty()) refuse_stranger(table_, kRoughnessCsvBegin, files_);
    if (!report_.empty()) refuse_stranger(report_, kRoughnessHtmlBegin, files_);
    const Json config = config_json(fields());
    const bool alone = files_.size() == 1;
    std::vector<RoughnessFound> found;
    std::vector<RoughnessFailure> failed;
    for (const std::string& file : files_) {
      observer.update("measuring",
                      static_cast<double>(found.size() + failed.size()) / static_cast<double>(files_.size()));
      reads(file == "-" ? "" : file);
      try {
        found.push_back(measure_file(file, settings_, config, !report_.empty()));
      } catch (const Error& error) {  // of several files also an option that is of another kind of file
        if (alone) throw;
        failed.push_back({file, with_input(error.what())});
        continue;
      }
      say(alone ? found.back().text : printable(file, 200) + "\n" + found.back().text + "\n");
    }
    reads("");
    if (!table_.empty()) write_file(table_, roughness_csv(found));
    if (!report_.empty()) write_file(report_, roughness_html(found, failed));
    print_json((alone ? found.front().json : list_of(found, failed)).dump_repaired(2));
    for (const RoughnessFailure& failure : failed) print_error(failure.message);
    return failed.empty() ? kDone : kBadInput;
  }

 private:
  static Json list_of(const std::vector<RoughnessFound>& found, const std::vector<RoughnessFailure>& failed) {
    Json out;
    out["format"] = "asperity-roughness-list";
    out["version"] = 1;
    out["files"] = Json::array();
    for (const RoughnessFound& one : found) out["files"].push_back(one.json);
    out["failed"] = Json::array();
    for (const RoughnessFailure& failure : failed)
      out["failed"].push_back({{"file", failure.file}, {"message", failure.message}});
    return out;
  }

  void set_choice(const char* option, const char* field, const std::string& value) {
    if (value.empty()) return;
    try {
      set_field(fields(), field, value);
    } catch (const Error& error) {
      throw UsageError(std::string(option) + ": " + error.what());
    }
  }

  std::vector<std::string> files_;
  std::string table_, report_;
  std::string spacing_;
  std::string class_;
  std::string noise_;
  std::string lambda_s_;
  std::string lambda_c_;
  std::string lambda_f_;
  std::string filter_;
  RoughnessSettings settings_;
};

}  // namespace

std::unique_ptr<Command> make_roughness(Parser& root) { return std::make_unique<RoughnessCommand>(root); }

}  // namespace asperity::app

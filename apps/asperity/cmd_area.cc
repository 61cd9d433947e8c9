#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/geometry/triangle_mesh.h"
#include "asperity/pipeline/make_area.h"
#include "asperity/session/area_input.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/write_area.h"
#include "commands.h"

namespace asperity::app {

namespace {

class AreaCommand : public Command {
 public:
  explicit AreaCommand(Parser& root)
      : Command(root, "area", "Make one areal texture of many registered scans over a patch") {
    require(parser().add_option("REGISTERED", folder_, "A folder that `register` wrote, with several scans"));
    parser()
        .add_option("--leave-out", leave_out_, "A scan that is used for the pose only; may be repeated")
        ->one_value_each()
        ->type_name("SCAN");
    require(parser().add_option("-o,--output", output_, "Folder of the scene with the area"))->type_name("OUT");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  int run(const Observer& observer) override {
    // What was measured of the scans is in there, and OUT is replaced as a whole.
    std::error_code unknown;
    if (fs::equivalent(folder_, output_, unknown))
      throw UsageError("-o: " + printable(output_, 200) + " is REGISTERED itself; choose another output folder");
    OutputFolder folder(output_, naming_added(is_our_folder));
    observer.update("reading", 0.0);
    reads(folder_);
    const AreaInput input = read_area_input(folder_, observer, leave_out_);
    const SceneObject& object = input.scene.objects.front();
    const AreaResult area =
        make_area(to_metres(object.mesh, object.unit_m), input.scans, input.registered, config_, observer);
    reads("");
    observer.update("writing", 1.0);
    const std::string json = write_area(folder.path(), input, area);
    commit_output(folder, output_);
    print_json(trim(json));
    std::string left_out;
    for (const LeftOutScan& scan : input.left_out)
      left_out += "left out      " + printable(scan.name, 200) + ": " + printable(scan.reason, 1000) + "\n";
    say(left_out + summary(area, input.scans.size()) + "scene in " + printable(output_, 200) + "\n");
    for (const Verdict& verdict : area.verdicts)
      if (verdict.severity != Severity::kNote) print_error(verdict_line(verdict));
    return area.trustworthy ? kDone : kNotTrustworthy;
  }

 private:
  static std::string summary(const AreaResult& area, std::size_t scans) {
    const StrokeMap& map = area.map;
    std::string out = fmt::format(
        "patch         {} triangles, {:.0f} mm², of which {:.0f} % have heights; stretch {:.3f} to {:.3f}\n"
        "strokes       {}, {} pairs meet",
        area.patch_triangles, 1e6 * area.area_m2, 100.0 * area.covered, area.flat.stretch_min, area.flat.stretch_max,
        scans, map.ties);
    if (std::isfinite(map.agreement)) {
      out += fmt::format(" and share {:.0f} ± {:.0f} % of their variance", 100.0 * map.agreement,
                         100.0 * map.agreement_sigma);
    }
    out += "\n";
    if (!area.texture) return out + "map           none\n";
    out += fmt::format(
        "map           {} x {} points {:.3f} mm apart, {:.1f} µm RMS ± {:.1f} µm, correlation length {:.2f} mm\n",
        map.texture.surface.columns, map.texture.surface.rows, 1e3 * map.texture.surface.spacing_x_m, 1e6 * map.rms_m,
        1e6 * map.sigma_rms_m, map.correlation_mm);
    if (map.held_out.samples > 0.0) {
      out += fmt::format(
          "predicted     {} strokes from the others, error {:.1f} µm RMS, {:.2f} of its standard deviation\n",
          map.held_out.strokes, 1e6 * map.held_out.error_rms_m, map.held_out.error_over_sigma);
    }
    for (const Problem& problem : area.problems) out += "note          " + problem.message + "\n";
    return out;
  }

  std::string folder_, output_;
  std::vector<std::string> leave_out_;
  AreaConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_area_command(Parser& root) { return std::make_unique<AreaCommand>(root); }

}  // namespace asperity::app

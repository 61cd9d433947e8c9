#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/json/config_json.h"
#include "asperity/json/json.h"
#include "asperity/plot/format_drawing.h"
#include "asperity/session/our_file.h"
#include "asperity/studio/result_figure.h"
#include "commands.h"
#include "option_units.h"

namespace asperity::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostResults = 32;

class PlotCommand : public Command {
 public:
  explicit PlotCommand(Parser& root) : Command(root, "plot", "Draw results as SVG, PNG or PDF") {
    require(parser().add_option(
        "RESULT", results_,
        "Folders of process, register, merge or area, a profile.csv, an areal *.texture.json, or heights in any file "
        "that `roughness` reads; several are laid over each other"));
    require(parser().add_option("-o,--output", output_, "File of the picture; its ending states the format"))
        ->type_name("FILE.svg|FILE.png|FILE.pdf");
    parser()
        .add_option("--parts", parts_text_,
                    "Panels: profile, texture, spectrum, path, compliance, map; all if not given")
        ->type_name("PART,…")
        ->suggest(studio::kFigurePartNames);
    parser()
        .add_option("--spacing", spacing_, "Distance of the heights, for a file without positions")
        ->type_name("LENGTH");
    parser().add_option("--resolution", resolution_, "Pixels of a PNG for each of 900 across, 0.25 to 16 (2)");
  }

  std::vector<ConfigField> fields() override { return list_fields("", config_); }

  void apply_options() override {
    if (!spacing_.empty()) config_.input.spacing_m = length_option_m("--spacing", spacing_);
  }

  int run(const Observer& observer) override {
    const DrawingFormat format = format_of(output_);
    if (!(resolution_ >= 0.25 && resolution_ <= 16.0))
      throw UsageError("--resolution: the value must be between 0.25 and 16");
    if (results_.size() > kMostResults)
      throw UsageError("more than " + std::to_string(kMostResults) + " results, too many for one plot");
    const std::vector<studio::FigurePart> parts = parts_of(parts_text_);
    refuse_stranger(
        output_, [format](std::string_view begin) { return begins_as_plot(begin, format); }, results_);
    observer.update("reading", 0.0);
    if (results_.size() == 1) reads(results_.front());
    const studio::ResultFigure figure = studio::make_result_figure(sources(), parts, config_);
    reads("");
    observer.update("drawing", 0.5);
    std::string content = format_drawing(draw_figure(figure.figure), format, resolution_);
    if (format == DrawingFormat::kPng) content = signed_png(std::move(content));
    write_file(output_, content);
    report(figure);
    return kDone;
  }

 private:
  static DrawingFormat format_of(const std::string& file) {
    std::string ending = fs::path(file).extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (std::size_t i = 0; i < kDrawingFormatNames.size(); ++i)
      if (ending == "." + std::string(kDrawingFormatNames.at(i))) return static_cast<DrawingFormat>(i);
    throw UsageError("-o: " + printable(file, 200) + " does not end in .svg, .png or .pdf");
  }

  static bool begins_as_plot(std::string_view begin, DrawingFormat format) {
    switch (format) {
      case DrawingFormat::kSvg:
        return begin.starts_with(kSvgBegin);
      case DrawingFormat::kPng:
        return begins_as_signed_png(begin);
      case DrawingFormat::kPdf:
        return begin.substr(0, 32).find(kPdfMark) != std::string_view::npos;
    }
    return false;
  }

  static std::vector<studio::FigurePart> parts_of(const std::string& text) {
    std::vector<studio::FigurePart> out;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      const std::string word(trim(text.substr(begin, end - begin)));
      const auto& names = studio::kFigurePartNames;
      const auto found = std::find(names.begin(), names.end(), word);
      if (found == names.end())
        throw UsageError("--parts: '" + printable(word, 60) +
                         "' is none of profile, texture, spectrum, path, compliance and map");
      out.push_back(static_cast<studio::FigurePart>(found - names.begin()));
      begin = end + 1;
    }
    return out;
  }

  // The last name of each path, or the whole where two are alike.
  std::vector<studio::FigureSource> sources() const {
    std::vector<studio::FigureSource> out;
    for (const std::string& text : results_) {
      fs::path path = fs::path(text).lexically_normal();
      if (!path.has_filename()) path = path.parent_path();
      out.push_back({printable(path.filename().string(), 60), text});
    }
    for (studio::FigureSource& one : out) {
      const auto alike =
          std::count_if(out.begin(), out.end(), [&](const auto& other) { return other.name == one.name; });
      if (alike > 1 || one.name == "." || one.name.empty()) one.name = printable(one.path.generic_string(), 100);
    }
    return out;
  }

  void report(const studio::ResultFigure& figure) {
    Json out;
    out["format"] = "asperity-plot";
    out["version"] = 1;
    out["file"] = printable(output_, 4096);
    out["drawn"] = Json::array();
    for (const studio::FigurePart part : figure.drawn)
      out["drawn"].push_back(std::string(studio::kFigurePartNames.at(static_cast<std::size_t>(part))));
    out["missing"] = Json::array();
    for (const std::string& missing : figure.missing) out["missing"].push_back(missing);
    out["note"] = figure.figure.note;
    out["config"] = config_json(fields());
    print_json(out.dump_repaired(2));
    std::string text = printable(output_, 200) + ": ";
    for (std::size_t i = 0; i < figure.drawn.size(); ++i)
      text +=
          (i == 0 ? "" : ", ") + std::string(studio::kFigurePartNames.at(static_cast<std::size_t>(figure.drawn[i])));
    for (const std::string& missing : figure.missing) text += "\nnot drawn  " + missing;
    if (!figure.figure.note.empty()) text += "\nnote       " + figure.figure.note;
    say(text + "\n");
  }

  std::vector<std::string> results_;
  std::string output_, parts_text_, spacing_;
  double resolution_ = 2.0;
  studio::ResultFigureConfig config_;
};

}  // namespace

std::unique_ptr<Command> make_plot(Parser& root) { return std::make_unique<PlotCommand>(root); }

}  // namespace asperity::app

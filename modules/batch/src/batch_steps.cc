#include "asperity/batch/batch_steps.h"

#include <algorithm>

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Options that name a file of the plan's folder, such as --config FILE, are inputs too.
void add_named_files(const BatchPlan& plan, const BatchOptions& options, BatchStep& step) {
  for (const std::string& path : options.possible_paths()) {
    std::error_code ignored;
    if (fs::exists(plan.folder / path, ignored)) step.inputs.push_back(path);
  }
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

// A path that cannot be taken for an option.
std::string as_argument(const std::string& path) { return path.starts_with('-') ? "./" + path : path; }

}  // namespace

fs::path scan_folder(const std::string& output, const BatchScan& scan) { return fs::path(output) / scan.name; }

BatchStep process_step(const BatchPlan& plan, const BatchScan& scan, const std::string& output) {
  BatchStep out;
  out.name = "process";
  out.output = (scan_folder(output, scan) / "process").string();
  out.words = {"process", as_argument(scan.path), "-o", out.output};
  append(out.words, plan.process.words);
  out.inputs = {scan.path};
  add_named_files(plan, plan.process, out);
  return out;
}

std::vector<std::string> processed_pieces(const fs::path& process_folder) {
  std::error_code error;
  if (fs::is_regular_file(process_folder / "result.json", error)) return {""};
  std::vector<std::string> out;
  for (fs::directory_iterator i(process_folder, error), end; !error && i != end; i.increment(error)) {
    std::error_code ignored;
    if (fs::is_regular_file(i->path() / "result.json", ignored)) out.push_back(i->path().filename().string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<BatchStep> later_steps(const BatchPlan& plan, const BatchScan& scan, const std::string& output) {
  const fs::path folder = scan_folder(output, scan);
  std::vector<BatchStep> out;
  for (const std::string& piece : processed_pieces(plan.folder / folder / "process")) {
    const std::string profile = (folder / "process" / piece / "profile.csv").string();
    const std::string name = flat_name(scan.name) + (piece.empty() ? "" : "-" + piece);
    const std::string suffix = piece.empty() ? "" : " " + piece;
    if (plan.texture) {
      BatchStep step;
      step.name = "texture" + suffix;
      step.output = (folder / (name + ".texture.json")).string();
      step.words = {"texture", "fit", as_argument(profile), "-o", step.output};
      append(step.words, plan.texture->words);
      step.inputs = {profile};
      add_named_files(plan, *plan.texture, step);
      out.push_back(step);
    }
    if (plan.roughness) {
      BatchStep step;
      step.name = "roughness" + suffix;
      step.output = (folder / (name + ".roughness.json")).string();
      step.words = {"roughness", as_argument(profile), "--json"};
      append(step.words, plan.roughness->words);
      step.inputs = {profile};
      step.json_to_output = true;
      add_named_files(plan, *plan.roughness, step);
      out.push_back(step);
    }
  }
  if (plan.registration) {
    BatchStep step;
    step.name = "register";
    step.output = (folder / "register").string();
    step.words = {"register", as_argument(scan.path), as_argument(plan.mesh), "-o", step.output};
    append(step.words, plan.registration->words);
    step.inputs = {scan.path, plan.mesh};
    add_named_files(plan, *plan.registration, step);
    out.push_back(step);
  }
  return out;
}

}  // namespace asperity

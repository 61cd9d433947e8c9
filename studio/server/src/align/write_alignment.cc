#include "align/write_alignment.h"

#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "align/align_run.h"
#include "align/shell_words.h"
#include "asperity/base/folder_content.h"
#include "asperity/base/output.h"
#include "asperity/base/text.h"
#include "asperity/pipeline/write_registration.h"
#include "asperity/session/our_folder.h"
#include "asperity/session/register_input.h"
#include "asperity/session/scene_folder.h"
#include "asperity/studio/calls.h"
#include "asperity/verdict/verdict_json.h"
#include "json_pose.h"
#include "write_target.h"

namespace asperity::studio {

namespace {

struct Start {
  std::optional<Pose> guess;
  bool near = false;
};

Start start_of(const AlignChoice& choice) {
  if (!choice.T_mesh_world) {
    throw Advice("the path is not on the mesh yet", "Move it there by hand, by picked points or by a registration.");
  }
  const std::optional<AlignChoice::Registered>& registered = choice.registered;
  const bool unmoved = registered && json_of_pose(registered->T_mesh_world) == json_of_pose(*choice.T_mesh_world);
  return unmoved ? Start{registered->guess, registered->near} : Start{choice.T_mesh_world, false};
}

std::string command_of(const AlignChoice& choice, const Start& start, const std::optional<std::string>& name) {
  std::string out = "asperity register";
  for (const std::string& path : choice.paths) out += " " + shell_quoted(path);
  if (name) out += " " + shell_quoted(choice.mesh);
  if (!is_of_scene(choice)) out += " --mesh-unit " + shell_quoted(reading_of(choice).text);
  if (start.guess) {
    std::string numbers;
    for (const Json& number : json_of_pose(*start.guess)) {
      if (!numbers.empty()) numbers += ',';
      append_number(numbers, number.get<double>());
    }
    out += " --guess=" + numbers;
  }
  if (choice.paths.size() > 1) out += " --placement same";
  for (const std::string& texture : choice.textures) out += " --texture " + shell_quoted(texture);
  for (const auto& [path, value] : choice.config) out += " --set " + shell_quoted(path + "=" + value);
  if (start.near) {
    out += " --set search.registration.starts.when=never --set refinement.other_starts=0";
  }
  return out + (name ? " -o " + shell_quoted(*name) : " --into " + shell_quoted(choice.mesh));
}

}  // namespace

Json write_alignment(const AlignChoice& choice, const Project& project, const std::optional<std::string>& name,
                     Hub& hub, const Observer& observer) {
  const Start start = start_of(choice);
  if (!name && !is_of_scene(choice))
    throw Advice("the mesh is not that of a scene", "Choose a scene.json as the mesh, or write into a folder.");
  std::optional<OutputFolder> folder;
  if (name) folder.emplace(project.writable(*name), naming_added(is_registration_folder));
  observer.update("reading", 0.0);
  std::vector<std::string> scans, textures;
  for (const std::string& path : choice.paths) scans.push_back(project.existing(path).string());
  for (const std::string& texture : choice.textures) textures.push_back(project.existing(texture).string());
  RegisterInput input =
      read_register_input(scans, project.existing(choice.mesh).string(), unit_to_read_m(choice), textures, observer);
  std::optional<SceneFolder> scene_folder;
  if (!name) scene_folder.emplace(input.onto);
  const ScansOnMesh result = register_input(input, start.guess, run_config(choice, start.near), observer);
  observer.update("writing", 1.0);
  const std::filesystem::path place = folder ? folder->path() : scene_folder->path();
  const bool listing = input.onto.files.contains("files.json");
  const std::string scene = name ? *name + "/" + input.onto.file : choice.mesh;
  write_registration(place, result, input.scans, std::move(input.onto), listing);
  if (listing) write_listing(place);
  if (folder) {
    put_in_place(*folder, *name, hub);
  } else {
    scene_folder->commit();
  }

  Json out;
  out["name"] = name ? *name : std::filesystem::path(choice.mesh).parent_path().string();
  out["scene"] = scene;
  out["trustworthy"] = result.trustworthy;
  out["verdict"] = result.verdict.empty() ? result.placements.front().registration.verdict : result.verdict;
  out["verdicts"] = verdicts_json(result.verdicts);
  out["T_mesh_world"] = json_of_pose(result.placements.front().registration.T_mesh_world);
  out["command"] = command_of(choice, start, name);
  return out;
}

}  // namespace asperity::studio

#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/json/json.h"
#include "asperity/scene/lay_texture.h"
#include "asperity/scene/scene.h"

namespace asperity {

// A scene to which scans are added or from which one is taken out, and what is beside it. A mesh alone is one too.
struct EarlierScene {
  Scene scene;
  std::string file = "scene.json";  // in `folder`
  std::filesystem::path folder;     // resolved, absolute; empty: a mesh alone
  std::filesystem::path given;      // the same as the caller named it, for messages
  std::set<std::string> files;      // that we have written into the folder: they go on with the scene
  std::set<std::string> own_files;  // that the scene had when it was read: they are written again
  Json registration;                // of registration.json; null if there is none
  std::string checksum;             // of both files when they were read
  LayAt at = LayAt::kOver;          // where scans are laid that the scene does not have yet
  std::string date;                 // for the scans' origins; empty: none

  SceneObject& object() { return scene.objects.front(); }
  const SceneObject& object() const { return scene.objects.front(); }
};

EarlierScene scene_of_mesh(MeshFile mesh, double unit_m);

// Reads a scene.json with the registration.json beside it. Textures whose origin the scene does not have, for it was
// written before scenes had any, get it from there. Throws Error as read_scene does, and for a registration.json that
// cannot be read.
EarlierScene read_earlier_scene(const std::filesystem::path& scene, const Observer& observer = {});

// The checksum of a scene.json and the registration.json beside it, as they are now. Throws Error if one cannot be
// read.
std::string scene_checksum(const std::filesystem::path& folder, const std::string& scene);

// All files of a folder that asperity has written into it, by what its registration.json and files.json list, with
// these and a report.html; empty if neither is there. Never throws.
std::set<std::string> files_of_ours(const std::filesystem::path& folder) noexcept;

// The scans of a scene, by their textures' index.
std::vector<const SceneTexture*> scans_of(const Scene& scene);

// What was measured of a scan, by registration.json; where that has no list, its folder or what a single scan has
// beside the scene.
std::set<std::string> files_of_scan(const EarlierScene& earlier, const std::string& name);

// What is stored of a scene's scans, as in registration.json, by their textures' index; of those that it does not list
// what the scene has.
std::map<int, Json> stored_scans(const EarlierScene& earlier);

// What is stored of a scene's placements, the first for number 1, without the scans called `gone`; a placement whose
// scans are all gone stays if others follow, so that their numbers do not change.
Json stored_placements(const EarlierScene& earlier, const std::vector<std::string>& gone);

// Where a scan goes in a scene.
struct ScanPlace {
  int texture = 1;  // its index: that of the scan of the same name, or a free one
  int order = 0;
  std::string file;       // of the texture
  int placement = 1;      // its number in the scene, from 1
  std::string folder;     // of what was measured; empty: beside the scene
  bool replaces = false;  // a scan of this name is there
};

// The places of scans in a scene. Throws Error if two have one name, or a folder cannot be called so.
std::vector<ScanPlace> place_scans(const EarlierScene& earlier, const std::vector<std::string>& names);

// Takes a scan out of the scene and its registration; gives the files of it that go with it. Throws Error naming the
// scans that there are if it is not one of them.
std::set<std::string> take_out_scan(EarlierScene& earlier, const std::string& name);

// Writes the scene and its registration (if any) into `folder`, and what else was beside the earlier one but for
// `dropped`. With `listing` a files.json is to follow, and is listed. Throws Error if two files would have one name.
void write_scene_again(const std::filesystem::path& folder, const EarlierScene& earlier,
                       const std::set<std::string>& dropped = {}, bool listing = false);

}  // namespace asperity

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "asperity/base/progress.h"
#include "asperity/geometry/mesh_file.h"
#include "asperity/geometry/mesh_limits.h"

namespace asperity {

// Reads glTF 2.0, as JSON (.gltf) or binary (.glb): the triangles, strips and fans of every mesh that a
// node of the default scene places, transformed into the scene's frame (metres, y up by glTF's
// convention). A node that mirrors reverses the triangles. Corners at the same position become one
// vertex; normals (transformed, unit) and TEXCOORD_0 (v inverted: glTF's v points down) are
// attributes of corners. Node or mesh names are objects. What write_gltf says about haptic coordinates
// is read back from TEXCOORD_1. Numbers are those of the file, mostly float32.
// Counted in `problems` and left out: points and lines, further texture coordinates, colours, tangents,
// morph targets, skins, animations, cameras, images inside the file, meshes that no node places.
//
// A buffer is in the file or in a file of `folder` or below, never elsewhere; with an empty `folder`
// only in the file. Images are never opened. Throws Error naming the file for what is not glTF 2.0, a
// required extension other than KHR_mesh_quantization, KHR_materials_unlit and KHR_texture_transform,
// sparse accessors, an index, accessor or buffer view that leaves its bounds, numbers that are not
// finite, nodes in a circle, no triangles, or more than `limits`; Cancelled while its JSON is read if `observer` says
// so.
MeshFile parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder = {},
                    const MeshLimits& limits = {}, const Observer& observer = {});

MeshFile read_gltf(const std::filesystem::path& path, const MeshLimits& limits = {}, const Observer& observer = {});

}  // namespace asperity

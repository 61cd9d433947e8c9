#include "asperity/scene/lay_texture.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <vector>

#include "asperity/base/error.h"
#include "asperity/texture/texture_file.h"

namespace asperity {

namespace {

using Stack = std::vector<HapticTriangle>;  // from the lowest to the highest

constexpr const char* kCoveredFile = "covered.csv";

// The stacks of the triangles that have more than one texture, and of those that are asked for.
class Stacks {
 public:
  explicit Stacks(SceneObject& object) : object_(object) {
    if (object.mesh.haptic.empty()) object.mesh.haptic.resize(object.mesh.triangles.size());
    for (const CoveredTriangle& one : object.covered) {
      if (one.triangle >= object.mesh.haptic.size()) throw Error("scene: a covered triangle is out of range");
      stacks_[one.triangle].push_back(one.haptic);
    }
    for (auto& [triangle, stack] : stacks_) add_highest(triangle, stack);
  }

  Stack& at(std::uint32_t triangle) {
    const auto [found, is_new] = stacks_.try_emplace(triangle);
    if (is_new) add_highest(triangle, found->second);
    return found->second;
  }
  std::map<std::uint32_t, Stack>& all() { return stacks_; }

  void put_back() {
    object_.covered.clear();
    for (const auto& [triangle, stack] : stacks_) {
      object_.mesh.haptic[triangle] = stack.empty() ? HapticTriangle{} : stack.back();
      for (std::size_t k = 0; k + 1 < stack.size(); ++k) object_.covered.push_back({triangle, stack[k]});
    }
    if (object_.covered.empty()) object_.covered_file.clear();
    if (!object_.covered.empty() && object_.covered_file.empty()) {
      object_.covered_file = kCoveredFile;
      const auto taken = [&](const std::string& name) {
        return std::any_of(object_.textures.begin(), object_.textures.end(),
                           [&](const SceneTexture& texture) { return texture.file == name; });
      };
      for (int n = 2; object_.covered_file == object_.material_file || taken(object_.covered_file); ++n)
        object_.covered_file = std::to_string(n) + "-" + kCoveredFile;
    }
  }

 private:
  void add_highest(std::uint32_t triangle, Stack& stack) const {
    const HapticTriangle& highest = object_.mesh.haptic[triangle];
    if (highest.texture >= 0) stack.push_back(highest);
  }

  SceneObject& object_;
  std::map<std::uint32_t, Stack> stacks_;
};

// Of a texture that only the mesh knows nothing is rendered: it must not hide another.
int order_of(const SceneObject& object, int index) {
  const SceneTexture* texture = object.find_texture(index);
  return texture == nullptr ? std::numeric_limits<int>::min() : texture->order;
}

}  // namespace

int further_order(const SceneObject& object, LayAt at, int except) {
  bool any = false;
  int low = 0, high = 0;
  for (const SceneTexture& texture : object.textures) {
    if (texture.index == except) continue;
    low = any ? std::min(low, texture.order) : texture.order;
    high = any ? std::max(high, texture.order) : texture.order;
    any = true;
  }
  if (!any) return 0;
  const int order = at == LayAt::kOver ? high + 1 : low - 1;
  if (std::abs(order) > kFurthestOrder) throw Error("scene: no texture order is free");
  return order;
}

void put_texture(SceneObject& object, SceneTexture texture) {
  const auto place = std::find_if(object.textures.begin(), object.textures.end(),
                                  [&](const SceneTexture& other) { return other.index >= texture.index; });
  if (place != object.textures.end() && place->index == texture.index) {
    *place = std::move(texture);
  } else {
    object.textures.insert(place, std::move(texture));
  }
}

LaidTriangles lay_triangles(SceneObject& object, std::span<const CoveredTriangle> claims) {
  const std::size_t triangles = object.mesh.triangles.size();
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (claims[i].triangle >= triangles || (i > 0 && claims[i].triangle < claims[i - 1].triangle))
      throw Error("scene: the triangles to lay are out of range or order");
  }
  LaidTriangles out;
  if (claims.empty()) return out;
  Stacks stacks(object);
  for (const CoveredTriangle& claim : claims) {
    Stack& stack = stacks.at(claim.triangle);
    const int index = claim.haptic.texture;
    std::erase_if(stack, [index](const HapticTriangle& other) { return other.texture == index; });
    const int order = order_of(object, index);
    auto place = stack.end();
    while (place != stack.begin() && order_of(object, std::prev(place)->texture) > order) --place;
    stack.insert(place, claim.haptic);
  }
  std::map<std::uint32_t, HapticTriangle> before;
  for (const CoveredTriangle& claim : claims) before.try_emplace(claim.triangle, object.mesh.haptic[claim.triangle]);
  const auto is_claimed = [&](std::uint32_t triangle, int index) {
    const auto first = std::lower_bound(claims.begin(), claims.end(), triangle,
                                        [](const CoveredTriangle& one, std::uint32_t t) { return one.triangle < t; });
    for (auto one = first; one != claims.end() && one->triangle == triangle; ++one) {
      if (one->haptic.texture == index) return true;
    }
    return false;
  };
  stacks.put_back();
  for (const auto& [triangle, was] : before) {
    const int now = object.mesh.haptic[triangle].texture;
    if (!is_claimed(triangle, now)) {
      ++out.under;
    } else if (was.texture >= 0 && !is_claimed(triangle, was.texture)) {
      ++out.over;
      ++out.covered[was.texture];
    }
  }
  return out;
}

std::vector<CoveredTexture> covered_textures(const SceneObject& object, const LaidTriangles& laid) {
  std::vector<CoveredTexture> out;
  for (const auto& [index, triangles] : laid.covered) {
    const auto still = std::count_if(object.mesh.haptic.begin(), object.mesh.haptic.end(),
                                     [index = index](const HapticTriangle& one) { return one.texture == index; });
    const SceneTexture* listed = object.find_texture(index);
    out.push_back({index, listed != nullptr ? listed->file : "", triangles, static_cast<std::size_t>(still)});
  }
  return out;
}

bool take_out_texture(SceneObject& object, int index) {
  const auto listed = std::find_if(object.textures.begin(), object.textures.end(),
                                   [index](const SceneTexture& texture) { return texture.index == index; });
  bool found = listed != object.textures.end();
  if (found) object.textures.erase(listed);
  Stacks stacks(object);
  for (std::uint32_t t = 0; t < object.mesh.haptic.size(); ++t) {
    if (object.mesh.haptic[t].texture == index) stacks.at(t);
  }
  for (auto& [triangle, stack] : stacks.all()) {
    found = std::erase_if(stack, [index](const HapticTriangle& one) { return one.texture == index; }) > 0 || found;
  }
  stacks.put_back();
  return found;
}

int free_texture_index(const SceneObject& object) {
  int index = 0;
  for (const SceneTexture& texture : object.textures) index = std::max(index, texture.index);
  for (const HapticTriangle& triangle : object.mesh.haptic) index = std::max(index, triangle.texture);
  for (const CoveredTriangle& one : object.covered) index = std::max(index, one.haptic.texture);
  if (index == std::numeric_limits<int>::max()) throw Error("scene: no texture index is free");
  return index + 1;
}

std::string free_file_name(const Scene& scene, const std::string& wanted, int number, int except) {
  const auto taken = [&](const std::string& name) {
    for (const char* ours : {"scene.json", "paint.json", "files.json", "registration.json", "area.json"})
      if (name == ours) return true;
    for (const SceneObject& object : scene.objects) {
      if (name == object.mesh_file || name == object.material_file || name == object.covered_file) return true;
      for (const SceneTexture& texture : object.textures) {
        const bool counts = texture.index != except || &object != &scene.objects.front();
        if (counts && texture_stem(texture.file) == texture_stem(name)) return true;
      }
    }
    return false;
  };
  std::string out = wanted;
  for (int n = number; taken(out); ++n) out = std::to_string(n) + "-" + wanted;
  return out;
}

}  // namespace asperity

#include "asperity/geometry/unique_material_names.h"

#include <map>
#include <set>

namespace asperity {

std::vector<std::string> unique_material_names(std::span<const MeshMaterial> materials) {
  std::set<std::string> taken;
  for (const MeshMaterial& material : materials) taken.insert(material.name);
  std::map<std::string, int> count;
  std::vector<std::string> out;
  for (const MeshMaterial& material : materials) {
    std::string name = material.name;
    int& n = ++count[material.name];
    while (n > 1 && !name.empty()) {
      name = material.name + "_" + std::to_string(n);
      if (taken.insert(name).second) break;
      ++n;
    }
    out.push_back(name);
  }
  return out;
}

}  // namespace asperity

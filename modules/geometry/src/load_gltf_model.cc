#include "load_gltf_model.h"

#include <optional>
#include <string_view>
#include <vector>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/base/text.h"

namespace asperity {

namespace {

struct Files {
  const std::filesystem::path& folder;
  std::string_view binary;
  std::uint64_t bytes_left;
};

bool read_buffer(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* user) {
  Files& files = *static_cast<Files*>(user);
  try {
    if (name == kBinaryChunk && !files.binary.empty()) {
      out->assign(files.binary.begin(), files.binary.end());
      return true;
    }
    const auto file = files.folder.empty() ? std::nullopt : inner_file(files.folder, name);
    if (!file) throw Error("it is outside the mesh's folder");
    const std::string content = read_file(*file, files.bytes_left);
    files.bytes_left -= content.size();
    out->assign(content.begin(), content.end());
    return true;
  } catch (const std::exception& failure) {
    *error = failure.what();
    return false;
  }
}

}  // namespace

tinygltf::Model load_gltf_model(const GltfDocument& document, const std::string& name,
                                const std::filesystem::path& folder, const MeshLimits& limits) {
  Files files{folder, document.binary, limits.file_bytes};
  tinygltf::FsCallbacks callbacks{
      [](const std::string&, void*) { return true; }, [](const std::string& path, void*) { return path; }, read_buffer,
      [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, &files};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(callbacks);
  tinygltf::Model model;
  std::string error;
  std::string warning;
  bool loaded = false;
  try {
    loaded = loader.LoadASCIIFromString(&model, &error, &warning, document.json.data(),
                                        static_cast<unsigned int>(document.json.size()), "");
  } catch (const std::exception& failure) {
    error = failure.what();
  }
  if (!loaded || !error.empty()) throw Error(name + ": is not glTF 2.0: " + printable(trim(error), 300));
  return model;
}

}  // namespace asperity

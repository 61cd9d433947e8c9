// A markers.json: refused with its name, or at most 1000 markers, each once and finite, that read the same when
// written.
#include "asperity/base/error.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/read_markers.h"
#include "fuzz_input.h"

using namespace asperity;

namespace {

std::string written(const MarkerFile& file) {
  Json out;
  out["markers"] = markers_json(file.markers);
  return out.dump();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  MarkerFile file;
  try {
    file = parse_markers(fuzz_text(data, size), "markers.json");
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("markers.json:"));
    return 0;
  }
  must(!file.markers.empty() && file.markers.size() <= 1000);
  for (const MarkerPlacement& marker : file.markers) {
    must(marker.T_marker_tag.translation_m.allFinite() && marker.T_marker_tag.rotation.coeffs().allFinite());
    must(marker.size_m > 0.0);
  }
  // A rotation is normalised when it is read: its last digit may change.
  const MarkerFile again = parse_markers(written(file), "again.json");
  must(again.markers.size() == file.markers.size());
  for (std::size_t i = 0; i < file.markers.size(); ++i) {
    const MarkerPlacement &one = file.markers[i], &other = again.markers[i];
    must(one.id == other.id && one.family == other.family && one.size_m == other.size_m);
    must(one.T_marker_tag.translation_m == other.T_marker_tag.translation_m);
    must(one.T_marker_tag.rotation.angularDistance(other.T_marker_tag.rotation) < 1e-7);
  }
  return 0;
}

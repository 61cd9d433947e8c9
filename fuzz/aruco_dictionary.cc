#include "asperity/tracking/aruco_dictionary.h"
#include "asperity/base/error.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const ArucoDictionary dictionary = parse_aruco_dictionary(fuzz_text(data, size), "d.yml");
    must(dictionary.bits >= 2 && dictionary.bits <= 16);
    must(!dictionary.markers.empty() && dictionary.markers.size() <= 2000);
    for (const auto& marker : dictionary.markers) {
      must(marker.size() == static_cast<std::size_t>(dictionary.bits * dictionary.bits));
    }
    must(dictionary.correctable_bits >= 0);
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("d.yml:"));
  }
  return 0;
}

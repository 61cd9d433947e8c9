// An HMPG is refused with an Error that names its file, or reads to an experience; if that can be written, it reads
// back to one that is written with the same bytes.
#include "asperity/base/error.h"
#include "asperity/scene/format_hmpg.h"
#include "asperity/scene/parse_hmpg.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  HapticExperience experience;
  try {
    experience = parse_hmpg(fuzz_text(data, size), "fuzz.hmpg");
  } catch (const Error& error) {
    must(std::string_view(error.what()).starts_with("fuzz.hmpg"));
    return 0;
  }
  std::size_t keyframes = 0;
  for (const HapticPerception& perception : experience.perceptions)
    for (const HapticChannel& channel : perception.channels) keyframes += channel.keyframes.size();
  must(3 * keyframes <= size);
  std::string written;
  try {
    written = format_hmpg(experience);
  } catch (const Error&) {  // more channels or effects than ids, vibrations that overlap
    return 0;
  }
  must(format_hmpg(parse_hmpg(written, "again.hmpg")) == written);
  return 0;
}

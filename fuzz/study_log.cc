// The log of a study is refused with an Error, or its rows are those of its study and its results can be printed.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/study/format_study_results.h"
#include "asperity/study/study_log.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const asperity::StudyLog log = asperity::parse_study_log(text, "fuzz");
    if (log.whole_bytes > size) std::abort();
    const asperity::StudyResults results = asperity::study_results(log.session);
    if (results.staircase) {
      for (const asperity::TrackResults& track : results.staircase->tracks) {
        if (track.threshold.level && !(*track.threshold.level > 0.0)) std::abort();
      }
    }
    if (asperity::study_results_text(results).empty()) std::abort();
    asperity::undetermined(results);
  } catch (const asperity::Error&) {
  }
  return 0;
}

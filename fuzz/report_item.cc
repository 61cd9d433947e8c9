// Three files in one input, each after a line "%%%": result.json, profile.csv, and, where it is there, trajectory.csv.
// They are refused with an Error, or make a block that a browser can read and a report can hold.
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/studio/block.h"
#include "asperity/studio/read_report_item.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kMark = "%%%\n";
  std::string_view rest = fuzz_text(data, size);
  std::array<std::optional<std::string_view>, 3> files;
  for (auto& file : files) {
    const auto end = rest.find(kMark);
    file = rest.substr(0, end);
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + kMark.size());
  }
  studio::ReportItem item;
  try {
    item = studio::parse_report_item(files[0].value(), files[1].value_or(""), files[2], "fuzz");
  } catch (const Error&) {
    return 0;
  }
  must(item.block.starts_with("ASB1"));
  must(item.block.size() < 64 * size + 100'000);
  return 0;
}

// checksums.txt, then after a line "%%%" a stream: what is said to have changed is a part of the stream, in order, and
// the work for it is in proportion to both. A stream's own checksums find no change in it.
#include "block_checksums.h"
#include "fuzz_input.h"

using namespace asperity;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::string_view kMark = "%%%\n";
  const std::string_view text = fuzz_text(data, size);
  const std::size_t mark = text.find(kMark);
  const std::string_view listed = text.substr(0, mark);
  const std::string_view content = mark == std::string_view::npos ? "" : text.substr(mark + kMark.size());
  std::uint64_t summed = 0, end = 0;
  for (const ChangedBytes& change : find_changes(content, parse_checksums(listed, "probe.csv"), &summed)) {
    must(change.begin >= end && change.begin <= change.end && change.end <= content.size());
    end = change.end;
  }
  must(summed <= 2 * content.size() + 16 * 3 * content.size());
  must(find_changes(content, parse_checksums(checksum_lines("probe.csv", content), "probe.csv")).empty());
  return 0;
}

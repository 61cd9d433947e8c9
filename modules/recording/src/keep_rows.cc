#include "keep_rows.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

#include "asperity/base/error.h"
#include "asperity/base/output.h"

namespace asperity {

namespace {

// The segments as spans that rise and do not touch.
std::vector<Segment> merge_overlapping(std::vector<Segment> segments) {
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.start_ns < b.start_ns; });
  std::vector<Segment> out;
  for (const Segment& segment : segments) {
    if (!out.empty() && segment.start_ns <= out.back().end_ns) {
      out.back().end_ns = std::max(out.back().end_ns, segment.end_ns);
    } else {
      out.push_back(segment);
    }
  }
  return out;
}

bool lies_in(const std::vector<Segment>& spans, const std::string& line) {
  std::int64_t t_ns = 0;
  if (std::from_chars(line.data(), line.data() + line.size(), t_ns).ec != std::errc())
    return true;  // not ours to judge
  const auto next = std::upper_bound(spans.begin(), spans.end(), t_ns,
                                     [](std::int64_t t, const Segment& span) { return t < span.start_ns; });
  return next != spans.begin() && t_ns <= std::prev(next)->end_ns;
}

// Hands each whole row that stays to `take`; true if there was one that does not.
template <class Take>
bool pass_rows(const std::filesystem::path& path, const std::vector<Segment>& spans, const Take& take) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path.string() + ": cannot be read");
  bool any_out = false;
  std::string line;
  for (bool header = true; std::getline(in, line) && !in.eof(); header = false) {
    if (header || lies_in(spans, line)) {
      take(line);
    } else {
      any_out = true;
    }
  }
  if (in.bad()) throw Error(path.string() + ": cannot be read");
  return any_out;
}

}  // namespace

bool has_other_rows(const std::filesystem::path& path, const std::vector<Segment>& segments) {
  return pass_rows(path, merge_overlapping(segments), [](const std::string&) {});
}

void keep_rows(const std::filesystem::path& path, const std::vector<Segment>& segments) {
  const std::vector<Segment> spans = merge_overlapping(segments);
  constexpr std::size_t kBatch_bytes = std::size_t{1} << 20;
  OutputFile out(path);
  std::string batch;
  pass_rows(path, spans, [&](const std::string& line) {
    batch += line;
    batch += '\n';
    if (batch.size() < kBatch_bytes) return;
    out.append(batch);
    batch.clear();
  });
  out.append(batch);
  out.commit();
}

}  // namespace asperity

#include "asperity/recorder/segment_writer.h"

#include <algorithm>
#include <utility>

#include "asperity/base/units.h"

namespace asperity {

namespace {

constexpr std::int64_t kLateness_ns = 1'000'000'000;
constexpr std::int64_t kSkew_ns = 10 * kLateness_ns;        // between the streams, at most
constexpr std::size_t kMostWaiting = std::size_t{1} << 18;  // rows of a ring, whatever their times

}  // namespace

SegmentWriter::SegmentWriter(RecordingAppender& appender, std::int64_t keep_ns)
    : appender_(appender), keep_ns_(keep_ns) {}

bool SegmentWriter::is_claimed(std::int64_t t_ns) const {
  // Rows come in order of time, but the two streams not with each other: a late one may belong before the last.
  for (auto segment = segments_.rbegin(); segment != segments_.rend() && t_ns <= segment->end_ns; ++segment) {
    if (t_ns >= segment->start_ns) return true;
  }
  // What was discarded may be wanted again, with the rows that come after the decision.
  return std::any_of(discarded_rows_.begin(), discarded_rows_.end(),
                     [t_ns](const Segment& segment) { return t_ns >= segment.start_ns && t_ns <= segment.end_ns; });
}

std::optional<std::int64_t> SegmentWriter::discarded_until_ns() const {
  std::int64_t until_ns = given_up_until_ns_;
  for (const Segment& segment : discarded_rows_) until_ns = std::max(until_ns, segment.end_ns);
  return until_ns == kNever ? std::nullopt : std::optional(until_ns);
}

template <class Sample>
void SegmentWriter::write(Stream<Sample>& stream, const Sample& sample) {
  appender_.add(sample);
  ++stream.written;
}

template <class Sample>
void SegmentWriter::take(Stream<Sample>& stream, const Sample& sample) {
  if (sample.t_ns <= stream.last_ns) {
    ++stream.late;
    return;
  }
  stream.last_ns = sample.t_ns;
  first_ns_ = std::min(first_ns_, sample.t_ns);
  latest_ns_ = std::max(latest_ns_, sample.t_ns);
  if (is_claimed(sample.t_ns)) {
    write(stream, sample);
    return;
  }
  stream.ring.push_back(sample);
  // Rows wait for the stream that is behind, if it is still coming.
  const std::int64_t behind_ns = std::min(probe_.last_ns, tracker_.last_ns);
  const std::int64_t reached_ns = behind_ns > latest_ns_ - kSkew_ns ? behind_ns : latest_ns_;
  while (!stream.ring.empty() &&
         (stream.ring.size() > kMostWaiting || stream.ring.front().t_ns < reached_ns - keep_ns_ - kLateness_ns)) {
    stream.ring.pop_front();
  }
}

template <class Sample>
void SegmentWriter::claim(Stream<Sample>& stream, std::int64_t start_ns) {
  for (const Sample& sample : stream.ring) {
    if (sample.t_ns >= start_ns) write(stream, sample);
  }
  stream.ring.clear();
}

void SegmentWriter::add(const ProbeSample& sample) { take(probe_, sample); }
void SegmentWriter::add(const TrackerSample& sample) {
  if (sample.body > bodies_.size()) bodies_.resize(sample.body);
  take(sample.body == 0 ? tracker_ : bodies_[sample.body - 1], sample);
}

std::uint64_t SegmentWriter::late_rows() const {
  std::uint64_t out = probe_.late + tracker_.late;
  for (const auto& body : bodies_) out += body.late;
  return out;
}

void SegmentWriter::claim_all(std::int64_t start_ns) {
  claim(probe_, start_ns);
  claim(tracker_, start_ns);
  for (auto& body : bodies_) claim(body, start_ns);
}

bool SegmentWriter::start(std::string name, std::int64_t t_ns, std::int64_t pre_roll_ns) {
  if (open_ || segments_.size() >= kMostSegments) return false;
  t_ns = std::max(t_ns, kFromFirstRow);
  const std::int64_t earliest_ns = std::max(first_ns_, discarded_until_ns().value_or(kNever));
  const std::int64_t start_ns = std::min(t_ns, std::max(t_ns - pre_roll_ns, earliest_ns));
  segments_.push_back({std::move(name), start_ns, kNoEnd});
  open_ = true;
  claim_all(start_ns);
  return true;
}

void SegmentWriter::end_at(std::int64_t t_ns) {
  if (open_) segments_.back().end_ns = std::max(t_ns, segments_.back().start_ns);
}

bool SegmentWriter::reopen() {
  if (!is_ending()) return false;
  segments_.back().end_ns = kNoEnd;
  claim_all(segments_.back().start_ns);
  return true;
}

bool SegmentWriter::settle(std::int64_t t_ns) {
  if (!is_ending() || std::max(t_ns, latest_ns_) < segments_.back().end_ns) return false;
  open_ = false;
  return true;
}

void SegmentWriter::close(std::int64_t t_ns) {
  if (!open_) return;
  if (latest_ns_ == kNever) segments_.pop_back();  // there was not one row
  if (latest_ns_ != kNever) end_at(std::min(t_ns, segments_.back().end_ns));
  open_ = false;
}

std::optional<std::string> SegmentWriter::discard(std::int64_t t_ns) {
  if (segments_.empty()) return std::nullopt;
  if (latest_ns_ != kNever) close(t_ns);
  open_ = false;
  Segment gone = std::move(segments_.back());
  segments_.pop_back();
  ++discarded_;
  if (latest_ns_ == kNever) return gone.name;  // it never had a row
  gone.start_ns = std::max(gone.start_ns, first_ns_);
  discarded_rows_.push_back(gone);
  if (discarded_rows_.size() > kMostDiscarded) {
    given_up_until_ns_ = std::max(given_up_until_ns_, discarded_rows_.front().end_ns);
    discarded_rows_.erase(discarded_rows_.begin());
  }
  return gone.name;
}

std::string SegmentWriter::free_name(const std::string& name) const {
  const auto taken = [this](const std::string& wanted) {
    return std::any_of(segments_.begin(), segments_.end(), [&](const Segment& each) { return each.name == wanted; });
  };
  std::string out = name;
  for (int i = 1; taken(out); ++i) out = name + (i == 1 ? "_restored" : "_restored_" + std::to_string(i));
  return out;
}

std::optional<std::string> SegmentWriter::restore() {
  if (discarded_rows_.empty() || segments_.size() >= kMostSegments) return std::nullopt;
  Segment back = std::move(discarded_rows_.back());
  discarded_rows_.pop_back();
  --discarded_;
  ++restored_;
  back.name = free_name(back.name);
  std::string name = back.name;
  // An open segment remains the last.
  const auto place = std::upper_bound(segments_.begin(), open_ ? segments_.end() - 1 : segments_.end(), back.start_ns,
                                      [](std::int64_t t_ns, const Segment& each) { return t_ns < each.start_ns; });
  segments_.insert(place, std::move(back));
  return name;
}

std::vector<Segment> SegmentWriter::segments() const {
  if (latest_ns_ == kNever) return {};
  std::vector<Segment> out = segments_;
  for (Segment& segment : out) segment.start_ns = std::max(segment.start_ns, first_ns_);
  if (open_) out.back().end_ns = std::max(out.back().start_ns, std::min(out.back().end_ns, latest_ns_));
  return out;
}

double SegmentWriter::recorded_s() const {
  if (latest_ns_ == kNever) return 0.0;
  std::int64_t sum_ns = 0;
  for (const Segment& segment : segments_) {
    const std::int64_t start_ns = std::max(segment.start_ns, first_ns_);
    sum_ns += std::max<std::int64_t>(0, std::min(segment.end_ns, latest_ns_) - start_ns);
  }
  return static_cast<double>(sum_ns) * kNanosecond_s;
}

}  // namespace asperity

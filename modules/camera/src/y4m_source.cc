#include "y4m_source.h"

#include <poll.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "asperity/base/host_clock.h"
#include "asperity/transport/byte_source.h"

namespace asperity {

namespace {

constexpr std::chrono::hours kLongestFrameWait{1};

}  // namespace

Y4mSource::Y4mSource(OwnedFile file, std::string name, bool is_file)
    : file_(std::move(file)), name_(std::move(name)), is_file_(is_file) {
  if (is_file_ && !wait_for_header(host_now_ns())) throw Error(name_ + ": ends within its header");
}

bool Y4mSource::wait_for_header(std::int64_t deadline_ns) {
  while (!header_ && !take_header()) {
    if (!fill(deadline_ns)) return false;
  }
  return true;
}

bool Y4mSource::read(CameraFrame& frame, std::chrono::milliseconds timeout) {
  if (failed_) throw LinkLost(name_ + ": was given up after a fault");
  const std::int64_t deadline_ns =
      host_now_ns() + std::chrono::nanoseconds(std::min<std::chrono::milliseconds>(timeout, kLongestFrameWait)).count();
  try {
    if (!wait_for_frame(deadline_ns)) return false;
  } catch (const LinkLost&) {
    throw;
  } catch (const Error&) {
    failed_ = true;  // where the next frame begins is not known
    throw;
  }
  frame.t_ns = finish_time();
  std::swap(frame.image, image_);
  ++index_;
  in_frame_ = false;
  return true;
}

double Y4mSource::nominal_rate_Hz() const {
  return header_ ? static_cast<double>(header_->rate_numerator) / static_cast<double>(header_->rate_denominator) : 0.0;
}

bool Y4mSource::wait_for_frame(std::int64_t deadline_ns) {
  while (!advance()) {
    if (!fill(deadline_ns)) {
      if (!ended_) return false;
      if (!header_ || in_frame_ || begin_ != end_) {
        throw LinkLost(name_ + ": ended within " + (header_ ? "frame " + std::to_string(index_ + 1) : "its header"));
      }
      throw LinkLost(name_ + ": has ended after frame " + std::to_string(index_));
    }
  }
  return true;
}

// Works on the bytes that are there; true once a frame is whole.
bool Y4mSource::advance() {
  if (!header_ && !take_header()) return false;
  if (!in_frame_) {
    const auto line = take_line();
    if (!line) return false;
    begin_frame(*line);
  }
  const std::size_t luma = std::min(end_ - begin_, image_.pixels.size() - luma_done_);
  std::memcpy(image_.pixels.data() + luma_done_, buffer_.data() + begin_, luma);
  luma_done_ += luma;
  begin_ += luma;
  const std::size_t chroma = std::min(end_ - begin_, chroma_left_);
  chroma_left_ -= chroma;
  begin_ += chroma;
  return luma_done_ == image_.pixels.size() && chroma_left_ == 0;
}

bool Y4mSource::take_header() {
  const auto line = take_line();
  if (!line) return false;
  header_ = parse_y4m_header(*line, name_);
  return true;
}

void Y4mSource::begin_frame(std::string_view line) {
  const std::string where = name_ + ": frame " + std::to_string(index_ + 1);
  const auto t_ns = parse_y4m_frame_line(line, where);
  if (index_ > 0 && t_ns.has_value() != timed_) {
    throw Error(where + (timed_ ? " has no Xt_ns, those before it have" : " has an Xt_ns, those before it have none"));
  }
  if (!t_ns && is_file_ && header_->rate_numerator == 0) {
    throw Error(where + ": there are neither Xt_ns nor a rate (F) in the header: no times are known");
  }
  if (t_ns && index_ > 0 && *t_ns <= t_ns_) {
    throw Error(where + ": Xt_ns=" + std::to_string(*t_ns) + " is not after " + std::to_string(t_ns_));
  }
  timed_ = t_ns.has_value();
  if (timed_) t_ns_ = *t_ns;
  image_.width = header_->width;
  image_.height = header_->height;
  image_.pixels.resize(header_->luma_bytes());
  luma_done_ = 0;
  chroma_left_ = header_->chroma_bytes();
  in_frame_ = true;
}

std::int64_t Y4mSource::finish_time() {
  if (timed_) return t_ns_;
  if (is_file_) {
    const long double seconds = static_cast<long double>(index_) * static_cast<long double>(header_->rate_denominator) /
                                static_cast<long double>(header_->rate_numerator);
    return t_ns_ = static_cast<std::int64_t>(std::llround(seconds * 1e9L));
  }
  // Two frames that were read at once still have times that rise.
  return t_ns_ = index_ > 0 ? std::max(last_read_ns_, t_ns_ + 1) : last_read_ns_;
}

// The next line without its newline, if it is whole; valid until fill().
std::optional<std::string_view> Y4mSource::take_line() {
  const std::string_view waiting(buffer_.data() + begin_, end_ - begin_);
  const auto newline = waiting.find('\n');
  if (std::min(newline, waiting.size()) > kLongestY4mLine) {
    throw Error(name_ + ": " + (header_ ? "the line of frame " + std::to_string(index_ + 1) : "the header") +
                " is longer than " + std::to_string(kLongestY4mLine) + " bytes");
  }
  if (newline == std::string_view::npos) return std::nullopt;
  begin_ += newline + 1;
  return waiting.substr(0, newline);
}

// Waits for bytes and takes what is there; false if none came in time or the stream has ended.
bool Y4mSource::fill(std::int64_t deadline_ns) {
  if (ended_) return false;
  if (begin_ == end_) begin_ = end_ = 0;
  if (end_ == buffer_.size()) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= std::exchange(begin_, 0);
  }
  for (;;) {
    pollfd wait{file_.get(), POLLIN, 0};
    const std::int64_t left_ns = std::max<std::int64_t>(deadline_ns - host_now_ns(), 0);
    const int ready =
        ::poll(&wait, 1, static_cast<int>(std::min<std::int64_t>((left_ns + 999'999) / 1'000'000, 60'000)));
    if (ready < 0 && errno != EINTR) throw Error(name_ + ": cannot be read: " + std::strerror(errno));
    if (ready > 0) break;
    if (host_now_ns() >= deadline_ns) return false;
  }
  const ssize_t count = ::read(file_.get(), buffer_.data() + end_, buffer_.size() - end_);
  if (count < 0) {
    if (errno == EAGAIN || errno == EINTR) return false;
    throw LinkLost(name_ + ": cannot be read: " + std::strerror(errno));
  }
  last_read_ns_ = host_now_ns();
  ended_ = count == 0;
  end_ += static_cast<std::size_t>(count);
  return !ended_;
}

}  // namespace asperity

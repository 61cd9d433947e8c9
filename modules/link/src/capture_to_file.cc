#include "asperity/link/capture_to_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <utility>

#include "asperity/base/text.h"
#include "capture_format.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

class NewFile {
 public:
  explicit NewFile(fs::path path) : path_(std::move(path)) {
    file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (file_ < 0 && errno == EEXIST) throw Error(path_.string() + ": exists already; nothing was changed");
    if (file_ < 0) fail();
  }
  ~NewFile() { ::close(file_); }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void append(const void* bytes, std::size_t size) {
    const auto* next = static_cast<const char*>(bytes);
    while (size > 0) {
      const ssize_t count = ::write(file_, next, size);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail();
      next += count;
      size -= static_cast<std::size_t>(count);
    }
  }

 private:
  [[noreturn]] void fail() const { throw Error(path_.string() + ": cannot be written: " + std::strerror(errno)); }

  fs::path path_;
  int file_ = -1;
};

class CapturingSource : public ByteSource {
 public:
  CapturingSource(std::unique_ptr<ByteSource> source, const fs::path& path)
      : source_(std::move(source)), bytes_(path), arrivals_(arrivals_path(path)) {
    arrivals_.append(kArrivalsHeader.data(), kArrivalsHeader.size());
  }

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    const Arrival arrival = source_->read(into, timeout);
    if (arrival.count == 0) return arrival;
    // A line without its bytes would be a fault, bytes without their line are merely not replayed.
    bytes_.append(into.data(), arrival.count);
    line_.clear();
    append_number(line_, static_cast<std::int64_t>(arrival.count));
    line_ += ',';
    append_number(line_, arrival.arrival_ns);
    line_ += '\n';
    arrivals_.append(line_.data(), line_.size());
    return arrival;
  }

  bool write(std::span<const std::uint8_t> bytes) override { return source_->write(bytes); }
  std::string name() const override { return source_->name(); }

 private:
  std::unique_ptr<ByteSource> source_;
  NewFile bytes_;
  NewFile arrivals_;
  std::string line_;
};

}  // namespace

std::unique_ptr<ByteSource> capture_to_file(std::unique_ptr<ByteSource> source, const fs::path& path) {
  return std::make_unique<CapturingSource>(std::move(source), path);
}

}  // namespace asperity

#include "asperity/link/capture_to_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <exception>
#include <utility>

#include "asperity/base/sync_folder.h"
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

  void sync() {
    if (::fsync(file_) == 0) return;
    throw Error(path_.string() + ": cannot be forced to the disk: " + std::strerror(errno));
  }

 private:
  [[noreturn]] void fail() const { throw Error(path_.string() + ": cannot be written: " + std::strerror(errno)); }

  fs::path path_;
  int file_ = -1;
};

class CapturingSource : public ByteSource {
 public:
  CapturingSource(std::unique_ptr<ByteSource> source, const fs::path& path, std::shared_ptr<CaptureFailure> failure)
      : source_(std::move(source)),
        folder_(path.parent_path()),
        failure_(std::move(failure)),
        bytes_(path),
        arrivals_(arrivals_path(path)) {
    arrivals_.append(kArrivalsHeader.data(), kArrivalsHeader.size());
  }

  ~CapturingSource() override {
    if (failed_) return;
    try {
      bytes_.sync();
      arrivals_.sync();
      sync_folder(folder_);
    } catch (const std::exception& error) {
      failure_->note(error.what());
    }
  }

  Arrival read(std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override {
    const Arrival arrival = source_->read(into, timeout);
    if (arrival.count > 0 && !failed_) keep(into.first(arrival.count), arrival.arrival_ns);
    return arrival;
  }

  bool write(std::span<const std::uint8_t> bytes) override { return source_->write(bytes); }
  std::string name() const override { return source_->name(); }

 private:
  // Who reads would take an error of the disk for a probe that was lost.
  void keep(std::span<const std::uint8_t> bytes, std::int64_t arrival_ns) {
    try {
      // A line without its bytes would be a fault, bytes without their line are merely not replayed.
      bytes_.append(bytes.data(), bytes.size());
      line_.clear();
      append_number(line_, static_cast<std::int64_t>(bytes.size()));
      line_ += ',';
      append_number(line_, arrival_ns);
      line_ += '\n';
      arrivals_.append(line_.data(), line_.size());
    } catch (const Error& error) {
      failed_ = true;
      failure_->note(error.what());
    }
  }

  std::unique_ptr<ByteSource> source_;
  fs::path folder_;
  std::shared_ptr<CaptureFailure> failure_;
  bool failed_ = false;
  NewFile bytes_;
  NewFile arrivals_;
  std::string line_;
};

}  // namespace

std::unique_ptr<ByteSource> capture_to_file(std::unique_ptr<ByteSource> source, const fs::path& path,
                                            std::shared_ptr<CaptureFailure> failure) {
  return std::make_unique<CapturingSource>(std::move(source), path, std::move(failure));
}

}  // namespace asperity

#include "asperity/recording/recording_appender.h"

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "asperity/base/error.h"
#include "asperity/base/output.h"
#include "asperity/base/sync_folder.h"
#include "asperity/recording/format_recording.h"
#include "asperity/recording/write_recording.h"
#include "block_checksums.h"
#include "csv_line.h"
#include "keep_rows.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBatch_bytes = 64 * 1024;

[[noreturn]] void fail(const fs::path& path) {
  throw Error(path.string() + ": cannot be written: " + std::strerror(errno));
}

// The innermost folder of `path` that is there.
fs::path existing_part(const fs::path& path) {
  std::error_code error;
  fs::path there = fs::absolute(path).lexically_normal();
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  return there;
}

// Rows that are forced to the disk are of no use under names that are not: those of the folders from `there` on.
void sync_names(const fs::path& folder, const fs::path& there) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  for (fs::path part = whole; part.has_relative_path(); part = part.parent_path()) {
    sync_folder(part);
    if (part == there) return;
  }
}

}  // namespace

struct RecordingAppender::Stream {
  fs::path path;
  int file = -1;
  std::string waiting;
  std::uint64_t bytes = 0;  // written
  BlockSum sum;

  void open_new(const fs::path& new_path, std::string header);
  void write();
  void close() noexcept;
};

void RecordingAppender::Stream::open_new(const fs::path& new_path, std::string header) {
  path = new_path;
  file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) fail(path);
  waiting = std::move(header);
  waiting.reserve(2 * kBatch_bytes);
  write();
}

void RecordingAppender::Stream::write() {
  std::size_t done = 0;
  while (done < waiting.size()) {
    const ssize_t count = ::write(file, waiting.data() + done, waiting.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      const int reason = errno;
      waiting.erase(0, done);
      errno = reason;
      fail(path);
    }
    sum.add(std::string_view(waiting).substr(done, static_cast<std::size_t>(count)));
    done += static_cast<std::size_t>(count);
    bytes += static_cast<std::uint64_t>(count);
  }
  waiting.clear();
}

void RecordingAppender::Stream::close() noexcept {
  if (file >= 0) ::close(file);
  file = -1;
}

RecordingAppender::RecordingAppender(fs::path folder, const RecordingInfo& info, const Calibration& calibration,
                                     const AppendColumns& columns)
    : folder_(std::move(folder)),
      columns_(columns),
      probe_(std::make_unique<Stream>()),
      tracker_(std::make_unique<Stream>()),
      checksums_(std::make_unique<Stream>()) {
  if (info.bodies.size() > kMostBodies)
    throw Error(folder_.string() + ": at most " + std::to_string(kMostBodies) + " bodies can be recorded");
  for (const TrackedBody& body : info.bodies) {
    body_files_.push_back(body_file(body.name));
    bodies_.push_back(std::make_unique<Stream>());
  }
  const fs::path there = existing_part(folder_);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw Error(folder_.string() + ": cannot be made: " + error.message());
  if (!fs::is_empty(folder_, error) || error)
    throw Error(folder_.string() + ": exists and is not empty; nothing was changed");
  write_recording_info(folder_ / "recording.json", info);
  write_calibration(folder_ / "calibration.json", calibration);
  try {
    probe_->open_new(folder_ / "probe.csv", probe_header(columns.gyro, columns.force3));
    tracker_->open_new(folder_ / "tracker.csv",
                       tracker_header(columns.markers, columns.reprojection, columns.sigmas, columns.sigmas));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i]->open_new(folder_ / body_files_[i],
                           tracker_header(columns.markers, columns.reprojection, columns.sigmas, columns.sigmas));
    }
    checksums_->open_new(folder_ / kChecksumFile, checksum_header());
    note_output(folder_);
    sync_names(folder_, there);
  } catch (...) {
    close();
    throw;
  }
}

RecordingAppender::~RecordingAppender() {
  try {
    if (probe_->file >= 0 && tracker_->file >= 0) flush();
  } catch (...) {
    // A destructor cannot report; whoever needs to know calls finish().
  }
  close();
}

std::vector<RecordingAppender::Stream*> RecordingAppender::streams() const {
  std::vector<Stream*> out{probe_.get(), tracker_.get()};
  for (const auto& body : bodies_) out.push_back(body.get());
  return out;
}

void RecordingAppender::close() noexcept {
  probe_->close();
  tracker_->close();
  for (const auto& body : bodies_) body->close();
  checksums_->close();
}

std::uint64_t RecordingAppender::bytes() const {
  std::uint64_t out = 0;
  for (const Stream* stream : streams()) out += stream->bytes;
  return out;
}

void RecordingAppender::write_checksums(bool to_disk) {
  for (Stream* stream : streams()) {
    const bool ends = stream->sum.is_full() || (to_disk && !stream->sum.is_empty());
    if (ends) append_checksum(checksums_->waiting, stream->path.filename().string(), stream->sum.take());
  }
  checksums_->write();
}

void RecordingAppender::add(const ProbeSample& sample) {
  std::string& out = probe_->waiting;
  append_time(out, sample.t_ns);
  append_cells(out, sample.accel_counts);
  append_cell(out, sample.force_counts);
  if (columns_.gyro) append_cells(out, sample.gyro_counts);
  if (columns_.force3) append_cells(out, sample.force3_counts);
  out += '\n';
  if (out.size() < kBatch_bytes) return;
  probe_->write();
  write_checksums(false);
}

void RecordingAppender::add(const TrackerSample& sample) {
  Stream& stream = sample.body == 0 ? *tracker_ : *bodies_.at(sample.body - 1);
  std::string& out = stream.waiting;
  append_time(out, sample.t_ns);
  append_cells(out, sample.T_world_marker.translation_m);
  append_cells(out, sample.T_world_marker.rotation);
  if (columns_.markers) append_cell(out, static_cast<double>(sample.markers));
  if (columns_.reprojection) append_cell(out, sample.reprojection_px);
  if (columns_.sigmas) {
    append_cells(out, sample.sigma_position_m);
    append_cells(out, sample.sigma_rotation_rad);
    append_cells(out, sample.noise_position_m);
    append_cells(out, sample.noise_rotation_rad);
  }
  out += '\n';
  if (out.size() < kBatch_bytes) return;
  stream.write();
  write_checksums(false);
}

void RecordingAppender::flush(bool to_disk) {
  for (Stream* stream : streams()) {
    if (stream->file < 0) throw Error(folder_.string() + ": the recording is finished");
    stream->write();
  }
  write_checksums(to_disk);
  if (!to_disk) return;
  std::vector<Stream*> all = streams();
  all.push_back(checksums_.get());
  for (const Stream* stream : all) {
    if (::fdatasync(stream->file) != 0) fail(stream->path);
  }
}

void RecordingAppender::finish(const RecordingInfo& info, bool only_segments) {
  flush(true);
  close();
  // First the list: whoever dies in between leaves rows that no segment claims, not segments without rows.
  write_recording_info(folder_ / "recording.json", info);
  if (!only_segments) return;
  const std::vector<Stream*> all = streams();
  if (std::none_of(all.begin(), all.end(), [&](const Stream* s) { return has_other_rows(s->path, info.segments); }))
    return;
  // The checksums are of the streams with those rows. Whoever dies in between leaves streams that nothing checks.
  std::error_code error;
  if (!fs::remove(checksums_->path, error)) throw Error(checksums_->path.string() + ": cannot be replaced");
  sync_folder(folder_);
  std::string lines = checksum_header();
  for (const Stream* stream : all) {
    keep_rows(stream->path, info.segments);
    lines += checksum_lines_of_file(stream->path);
  }
  write_file(checksums_->path, lines);
}

}  // namespace asperity

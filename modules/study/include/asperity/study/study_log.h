#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "asperity/base/problem.h"
#include "asperity/study/study_session.h"

namespace asperity {

inline constexpr std::string_view kStudyLogEnding = ".study.csv";
inline constexpr std::uint64_t kLargestStudyLog_bytes = std::uint64_t{16} << 20U;

// The text of a log (docs/studio-study.md): its beginning, with the session's study and its textures' check sums in a
// comment; and its rows, each with its newline. Version 2 has times of touch and forces; a log keeps its version.
inline constexpr int kStudyLogVersion = 2;
std::string format_log_head(const StudySession& session, const std::vector<std::uint32_t>& textures_crc32);
std::string format_answer_row(const StudySession& session, const StudyAnswer& answer, std::string_view date,
                              int version = kStudyLogVersion);
std::string format_taken_back_row(int trial, double since_begin_s, std::string_view date,
                                  int version = kStudyLogVersion);

struct StudyLog {
  StudySession session;  // after all rows
  // Of the stimuli, in their order (stimuli.h); empty: the log is of a time before they were written.
  std::vector<std::uint32_t> textures_crc32;
  double since_begin_s = 0.0;   // of the last row
  std::size_t whole_bytes = 0;  // without a last row that was cut off
  int version = kStudyLogVersion;
  Problems problems;
};

// Reads a log and follows it. Throws Error naming file and line if it is not a log of this version, and for a row that
// is not what the study and its seed give at this place.
StudyLog parse_study_log(std::string_view text, const std::string& name);

// A log that is being written, by one program at a time.
class StudyLogFile {
 public:
  // A new file; throws Error if it cannot be made or is there already.
  static StudyLogFile create(const std::filesystem::path& file, std::string_view head);
  // One that is there, its end cut off after `whole_bytes`. Throws Error; also where another program writes it, or has
  // written a row behind them.
  static StudyLogFile open(const std::filesystem::path& file, std::size_t whole_bytes);
  StudyLogFile(StudyLogFile&& other) noexcept;
  StudyLogFile& operator=(StudyLogFile&& other) noexcept;
  ~StudyLogFile();

  // Hands a row to the system, whole or not at all. Throws Error if the disk takes no more.
  void append(std::string_view row);
  // Brings what was appended to the disk; may take a while. Thread-safe beside append().
  void sync() const;

 private:
  StudyLogFile(int file, std::string name, std::size_t bytes) : file_(file), name_(std::move(name)), bytes_(bytes) {}

  int file_ = -1;
  std::string name_;
  std::size_t bytes_ = 0;
};

}  // namespace asperity

#include "asperity/study/study_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/text.h"
#include "asperity/json/json.h"
#include "asperity/study/study_file.h"

namespace asperity {

namespace {

constexpr std::array<std::string_view, 2> kMagics{"# asperity.study_log 1 ", "# asperity.study_log 2 "};
constexpr std::array<std::string_view, 2> kColumns{
    "event,trial,repetition,track,left,right,comparison,level,answer,correct,reversal,response_s,since_begin_s,date\n",
    "event,trial,repetition,track,left,right,comparison,level,answer,correct,reversal,response_s,since_begin_s,"
    "touch_left_s,touch_right_s,force_left_N,force_right_N,date\n"};

std::size_t index_of(int version) { return static_cast<std::size_t>(version - 1); }
constexpr double kSameLevel = 1e-9;  // of itself: another machine's exp and log
constexpr int kMostRuns = 1'000'000;

// Whole milliseconds: the quotient is the number nearest to its three decimals, so no more are written.
std::string seconds_text(double seconds) { return number_text(std::round(1e3 * seconds) / 1e3); }

std::string force_text(double force_N) { return number_text(std::round(1e3 * force_N) / 1e3); }

std::string answer_field(const Study& study, int value) {
  if (study.method == StudyMethod::kRating) return std::to_string(value);
  return value == 1 ? "right" : "left";
}

// What a row says of a trial, up to the level.
std::string trial_cells(const StudySession& session, const Trial& trial) {
  const std::vector<std::string>& names = session.study().stimuli;
  std::string out = std::to_string(trial.number) + ',' + std::to_string(trial.repetition) + ',';
  if (trial.track > 0) out += std::to_string(trial.track);
  out += ',' + names.at(static_cast<std::size_t>(trial.left)) + ',';
  if (trial.right >= 0) out += names.at(static_cast<std::size_t>(trial.right));
  out += ',';
  if (trial.level) out += trial.comparison_right ? "right" : "left";
  return out;
}

constexpr const char* kCrcs = "textures_crc32";

Json crcs_json(const Study& study, const std::vector<std::uint32_t>& crcs) {
  Json out = Json::object();
  for (std::size_t k = 0; k < crcs.size(); ++k) out[study.stimuli.at(k)] = fmt::format("{:08x}", crcs[k]);
  return out;
}

std::vector<std::uint32_t> crcs_of(const Json& value, const Study& study, const std::string& name) {
  const auto refuse = [&] {
    throw Error(name + ":1: " + kCrcs + ": eight hexadecimal digits are needed for each texture");
  };
  if (!value.is_object() || value.size() != study.stimuli.size()) refuse();
  std::vector<std::uint32_t> out;
  for (const std::string& stimulus : study.stimuli) {
    if (!value.contains(stimulus) || !value[stimulus].is_string()) refuse();
    const auto text = value[stimulus].get<std::string>();
    std::uint32_t crc = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), crc, 16);
    if (text.size() != 8 || error != std::errc() || end != text.data() + text.size()) refuse();
    out.push_back(crc);
  }
  return out;
}

// The session before its first row, and the check sums of its textures.
StudyLog log_of(std::string_view text, const std::string& name) {
  if (text.empty()) throw Error(name + ": is empty");
  int version = kStudyLogVersion;
  while (version > 0 && !text.starts_with(kMagics.at(index_of(version)))) --version;
  if (version == 0) throw Error(name + ":1: is not a log of a study of version 1 or 2");
  const std::size_t begin = kMagics.at(index_of(version)).size();
  const Json head = parse_study_text(text.substr(begin, text.find('\n') - begin), name + ":1");
  const bool has_crcs = head.is_object() && head.contains(kCrcs);
  if (!head.is_object() || head.size() != (has_crcs ? 4 : 3) || !head.contains("study") ||
      !head.contains("participant") || !head.contains("run") || !head["participant"].is_string() ||
      !head["run"].is_number_unsigned() || head["run"].get<std::uint64_t>() > kMostRuns) {
    throw Error(name + ":1: study, participant and run are needed");
  }
  const auto participant = head["participant"].get<std::string>();
  check_participant(participant);
  const Study study = read_study(head["study"], name + ":1");
  return {StudySession(study, participant, head["run"].get<int>()),
          has_crcs ? crcs_of(head[kCrcs], study, name) : std::vector<std::uint32_t>(),
          0.0,
          0,
          version,
          {}};
}

double time_of(const CsvReader& rows, std::size_t column) {
  const double value = rows.number(column);
  if (!(value >= 0.0 && value < 1e9)) rows.fail(column, "is not a time in seconds");
  return value;
}

double force_of(const CsvReader& rows, std::size_t column) {
  const double value = rows.number(column);
  if (!(value >= 0.0 && value < 1e6)) rows.fail(column, "is not a force in newtons");
  return value;
}

std::array<TileTouch, 2> touches_of(const CsvReader& rows, int version) {
  if (version < 2) return {};
  return {TileTouch{time_of(rows, rows.require("touch_left_s")), force_of(rows, rows.require("force_left_N"))},
          TileTouch{time_of(rows, rows.require("touch_right_s")), force_of(rows, rows.require("force_right_N"))}};
}

void follow_rows(StudyLog& log, CsvReader& rows, const std::string& name) {
  const std::size_t trial = rows.require("trial"), level = rows.require("level"), answer = rows.require("answer"),
                    response = rows.require("response_s"), since = rows.require("since_begin_s");
  StudySession& session = log.session;
  while (rows.next()) {
    log.since_begin_s = time_of(rows, since);
    if (rows.cell(rows.require("event")) == "taken_back") {
      if (!session.can_take_back() || rows.integer(trial) != session.answers().back().trial.number) {
        rows.fail(trial, "withdraws an answer that was not given");
      }
      session.take_back();
      continue;
    }
    if (rows.cell(rows.require("event")) != "answer") rows.fail(0, "is not an event that this program knows");
    if (!session.trial()) rows.fail(trial, "all trials are answered before it");
    const Trial& expected = *session.trial();
    std::string cells;
    for (std::size_t k = trial; k < level; ++k) cells += (k > trial ? "," : "") + std::string(rows.cell(k));
    const bool same_level = expected.level
                                ? std::abs(rows.number(level) - *expected.level) <= kSameLevel * *expected.level
                                : rows.empty(level);
    if (cells != trial_cells(session, expected) || !same_level) {
      throw Error(name + ":" + std::to_string(rows.line()) +
                  ": is not the trial that the study and its seed give: " + printable(cells, 200));
    }
    int value = 0;
    if (session.study().method == StudyMethod::kRating) {
      const std::int64_t rating = rows.integer(answer);
      if (rating < kLowestRating || rating > kHighestRating) rows.fail(answer, "is not a rating");
      value = static_cast<int>(rating);
    } else if (rows.cell(answer) == "right") {
      value = 1;
    } else if (rows.cell(answer) != "left") {
      rows.fail(answer, "is neither left nor right");
    }
    session.give(value, time_of(rows, response), log.since_begin_s, touches_of(rows, log.version));
  }
}

[[noreturn]] void fail(const std::string& name, const char* what) {
  throw Error(name + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

std::string format_log_head(const StudySession& session, const std::vector<std::uint32_t>& textures_crc32) {
  Json head;
  head["study"] = study_json(session.study());
  head["participant"] = session.participant();
  head["run"] = session.run();
  head[kCrcs] = crcs_json(session.study(), textures_crc32);
  const std::size_t newest = index_of(kStudyLogVersion);
  return std::string(kMagics.at(newest)) + head.dump() + '\n' + std::string(kColumns.at(newest));
}

std::string format_answer_row(const StudySession& session, const StudyAnswer& answer, std::string_view date,
                              int version) {
  std::string out = "answer," + trial_cells(session, answer.trial) + ',';
  if (answer.trial.level) out += number_text(*answer.trial.level);
  out += ',' + answer_field(session.study(), answer.value) + ',';
  if (answer.trial.level) {
    out += std::string(answer.correct ? "1" : "0") + ',' + (answer.reversal ? "1" : "0");
  } else {
    out += ',';
  }
  out += ',' + seconds_text(answer.response_s) + ',' + seconds_text(answer.since_begin_s) + ',';
  if (version >= 2) {
    for (const TileTouch& touch : answer.touches) out += seconds_text(touch.touch_s) + ',';
    for (const TileTouch& touch : answer.touches) out += force_text(touch.force_N) + ',';
  }
  out.append(date);
  return out + '\n';
}

std::string format_taken_back_row(int trial, double since_begin_s, std::string_view date, int version) {
  return "taken_back," + std::to_string(trial) + ",,,,,,,,,,," + seconds_text(since_begin_s) +
         (version >= 2 ? ",,,,," : ",") + std::string(date) + '\n';
}

StudyLog parse_study_log(std::string_view text, const std::string& name) {
  StudyLog out = log_of(text, name);
  // Rows would be appended to half a line.
  if (std::count(text.begin(), text.end(), '\n') < 2) throw Error(name + ":2: is cut off before its columns end");
  CsvReader rows(text, name);
  std::string columns;
  for (const std::string& column : rows.columns()) columns += (columns.empty() ? "" : ",") + column;
  if (columns + '\n' != kColumns.at(index_of(out.version)))
    throw Error(name + ":2: does not have the columns of a study's log");
  follow_rows(out, rows, name);
  out.whole_bytes = text.rfind('\n') + 1;
  if (rows.truncated()) {
    out.problems.push_back({"cut_off", name + ": the last row was cut off and does not count"});
  }
  return out;
}

namespace {

// Two programs would mix their rows.
void lock(int file, const std::string& name) {
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error(name + ": another program is writing this log");
}

// Behind what was read there may be a row that was cut off, which ends without a line break.
void refuse_added_rows(int file, const std::string& name, std::size_t whole_bytes) {
  std::array<char, 4096> rest{};
  const ssize_t count = ::pread(file, rest.data(), rest.size(), static_cast<off_t>(whole_bytes));
  const std::string_view text(rest.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  if (text.find('\n') != std::string_view::npos) throw Error(name + ": has changed since it was read; open it again");
}

}  // namespace

StudyLogFile StudyLogFile::create(const std::filesystem::path& file, std::string_view head) {
  const std::string name = file.filename().string();
  StudyLogFile out(::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666), name,
                   0);
  if (out.file_ < 0) fail(name, "cannot be made");
  lock(out.file_, name);
  try {
    out.append(head);
  } catch (const Error&) {
    ::unlink(file.c_str());
    throw;
  }
  return out;
}

StudyLogFile StudyLogFile::open(const std::filesystem::path& file, std::size_t whole_bytes) {
  const std::string name = file.filename().string();
  StudyLogFile out(::open(file.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW), name, whole_bytes);
  if (out.file_ < 0) fail(name, "cannot be written");
  lock(out.file_, name);
  refuse_added_rows(out.file_, name, whole_bytes);
  if (::ftruncate(out.file_, static_cast<off_t>(whole_bytes)) != 0) fail(name, "cannot be cut off after its last row");
  return out;
}

StudyLogFile::StudyLogFile(StudyLogFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)), name_(std::move(other.name_)), bytes_(other.bytes_) {}

StudyLogFile& StudyLogFile::operator=(StudyLogFile&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(name_, other.name_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

StudyLogFile::~StudyLogFile() {
  if (file_ >= 0) ::close(file_);
}

void StudyLogFile::append(std::string_view row) {
  for (std::size_t done = 0; done < row.size();) {
    const ssize_t written = ::write(file_, row.data() + done, row.size() - done);
    if (written > 0) {
      done += static_cast<std::size_t>(written);
    } else if (errno != EINTR) {
      const int reason = errno;
      // Half a row would be taken for one that was cut off, and what comes after it would be lost.
      if (::ftruncate(file_, static_cast<off_t>(bytes_)) != 0)
        fail(name_, "cannot be written, and its incomplete row cannot be removed");
      errno = reason;
      fail(name_, "cannot be written");
    }
  }
  bytes_ += row.size();
}

void StudyLogFile::sync() const {
  if (::fdatasync(file_) != 0) fail(name_, "cannot be stored on the disk");
}

}  // namespace asperity

#include "recover_stream.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/base/inner_path.h"
#include "asperity/recording/format_recording.h"
#include "block_checksums.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostMessages = 20;

std::size_t cells_of(std::string_view line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
}

std::string_view trim(std::string_view cell) {
  while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t')) cell.remove_suffix(1);
  return cell;
}

// Hands each cell of `line` to `take`, until it says no.
template <class Take>
bool pass_cells(std::string_view line, const Take& take) {
  for (;;) {
    const std::size_t comma = line.find(',');
    if (!take(trim(line.substr(0, comma)))) return false;
    if (comma == std::string_view::npos) return true;
    line.remove_prefix(comma + 1);
  }
}

bool is_number_or_empty(std::string_view cell) {
  if (cell.empty()) return true;
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

bool is_whole_number(std::string_view cell) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

// Numbers in each of `cells` columns, a whole one in the column of the time.
bool is_row(std::string_view line, std::size_t cells, std::size_t time_column) {
  if (cells_of(line) != cells) return false;
  std::size_t column = 0;
  return pass_cells(line, [&](std::string_view cell) {
    return column++ == time_column ? is_whole_number(cell) : is_number_or_empty(cell);
  });
}

// A line and the bytes [begin, end) that it takes, its newline among them.
struct Line {
  std::string_view text;
  std::uint64_t begin = 0, end = 0;
  std::size_t number = 0;
};

template <class Take>
void pass_lines(std::string_view content, const Take& take) {
  Line line;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t newline = content.find('\n', at);
    if (newline == std::string_view::npos) return;  // cut off
    std::size_t length = newline - at;
    if (length > 0 && content[newline - 1] == '\r') --length;
    line = {content.substr(at, length), at, newline + 1, line.number + 1};
    take(line);
    at = newline + 1;
  }
}

// The headers that a recorder of ours writes.
std::vector<std::string> own_headers(std::string_view file) {
  std::vector<std::string> out;
  if (file == "probe.csv") {
    for (const bool gyro : {false, true}) {
      for (const bool force3 : {false, true}) out.push_back(probe_header(gyro, force3));
    }
  } else {
    for (const auto& [seen, sigmas, noise] :
         {std::array{false, false, false}, {true, false, false}, {true, true, false}, {true, true, true}})
      out.push_back(tracker_header(seen, seen, sigmas, noise));
  }
  for (std::string& header : out) header.pop_back();  // the newline
  return out;
}

// All columns that a reader needs, in any order; gives the place of the time.
std::optional<std::size_t> time_column_of(std::string_view header, std::string_view file) {
  static constexpr std::array kProbe{"t_ns", "accel_i", "accel_j", "accel_k", "force"};
  static constexpr std::array kTracker{"t_ns", "px_m", "py_m", "pz_m", "qw", "qx", "qy", "qz"};
  std::vector<std::string_view> columns;
  pass_cells(header, [&](std::string_view cell) { return columns.push_back(cell), true; });
  const auto has = [&](std::string_view name) { return std::count(columns.begin(), columns.end(), name) == 1; };
  const bool all = file == "probe.csv" ? std::all_of(kProbe.begin(), kProbe.end(), has)
                                       : std::all_of(kTracker.begin(), kTracker.end(), has);
  if (!all) return std::nullopt;
  return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "t_ns") - columns.begin());
}

// The header of our own that has as many columns as most of the rows. A stream of the probe with a gyroscope has as
// many as one with three axes of force: that one is told by its first header only, so the former is taken.
std::string header_by_rows(std::string_view content, std::string_view file) {
  const std::vector<std::string> headers = own_headers(file);
  std::vector<std::size_t> rows(headers.size());
  pass_lines(content, [&](const Line& line) {
    for (std::size_t i = 0; i < headers.size(); ++i) {
      if (is_row(line.text, cells_of(headers[i]), 0)) ++rows[i];
    }
  });
  // The first of the largest: without force_x before with it, where both have as many columns.
  const auto most = std::max_element(rows.begin(), rows.end());
  const auto index = static_cast<std::size_t>(most - rows.begin());
  if (*most == 0) return {};
  if (file == "probe.csv" && cells_of(headers[index]) == 8) return headers[2];
  return headers[index];
}

class ChangedRows {
 public:
  explicit ChangedRows(std::vector<ChangedBytes> changes) : changes_(std::move(changes)) {}
  bool holds(const Line& line) {
    while (next_ < changes_.size() && changes_[next_].end <= line.begin) ++next_;
    return next_ < changes_.size() && changes_[next_].begin < line.end;
  }

 private:
  std::vector<ChangedBytes> changes_;
  std::size_t next_ = 0;
};

// Neighbouring lines of one kind become one message.
class Messages {
 public:
  Messages(std::string file, RecoveredStream& stream) : file_(std::move(file)), stream_(stream) {}
  void add(std::size_t line, const char* what) {
    if (what == what_ && line == last_ + 1) {
      last_ = line;
      return;
    }
    end();
    first_ = last_ = line;
    what_ = what;
  }

  void end() {
    if (what_ != nullptr && stream_.messages.size() < kMostMessages) {
      stream_.messages.push_back(first_ == last_ ? fmt::format("{}:{}: {}", file_, first_, what_)
                                                 : fmt::format("{}:{}-{}: {}", file_, first_, last_, what_));
    }
    what_ = nullptr;
  }

 private:
  std::string file_;
  RecoveredStream& stream_;
  std::size_t first_ = 0, last_ = 0;
  const char* what_ = nullptr;
};

}  // namespace

bool is_own_file(const fs::path& folder, const std::string& file) {
  if (!inner_file(folder, file)) return false;
  std::error_code error;
  const fs::file_status status = fs::status(folder / file, error);
  if (error && status.type() != fs::file_type::not_found)
    throw Error((folder / file).string() + ": cannot be read: " + error.message());
  return fs::is_regular_file(status);
}

std::string recover_stream(const fs::path& folder, const std::string& file, std::string_view checksums,
                           const RecoverOptions& options, const ReadLimits& limits, RecoveredStream& stream) {
  stream.file = file;
  if (!is_own_file(folder, file)) {
    stream.messages.push_back(file + ": is not there");
    return {};
  }
  const std::string content = read_file(folder / file, limits.csv_bytes);
  const std::vector<BlockChecksum> blocks = parse_checksums(checksums, file);
  stream.checked = !blocks.empty();
  const std::vector<ChangedBytes> changes = find_changes(content, blocks);
  const bool gone =
      std::any_of(changes.begin(), changes.end(), [](const auto& change) { return change.begin == change.end; });
  if (gone || (stream.checked && blocks.back().begin + blocks.back().bytes > content.size())) {
    stream.rows_missing = true;
    stream.messages.push_back(file + ": rows that were recorded are missing, by checksums.txt");
  }
  if (!content.empty() && content.back() != '\n') {
    ++stream.unreadable_rows;
    stream.messages.push_back(file + ": the last line has no end; left out");
  }
  ChangedRows changed(changes);

  std::string header;
  std::size_t header_line = 0, time_column = 0;
  pass_lines(content, [&](const Line& line) {
    if (header_line > 0 || line.text.empty() || line.text.front() == '#') return;
    header_line = line.number;
    header = line.text;
  });
  if (const auto found = time_column_of(header, file)) {
    time_column = *found;
  } else {
    header = header_by_rows(content, file);
    stream.header_replaced = true;
    stream.messages.push_back(fmt::format("{}:{}: the header cannot be read{}", file, header_line,
                                          header.empty() ? "" : "; replaced by the number of columns: " + header));
    if (header.empty()) return {};
  }
  stream.found = true;

  const std::size_t cells = cells_of(header);
  std::string out = header + '\n';
  Messages messages(file, stream);
  pass_lines(content, [&](const Line& line) {
    if (line.text.empty() || line.text.front() == '#') return;
    const bool row = is_row(line.text, cells, time_column), differs = changed.holds(line);
    if (line.number == header_line && !row) return;
    if (!row) {
      ++stream.unreadable_rows;
      messages.add(line.number, "not a row of this file; left out");
      return;
    }
    if (differs) {
      ++stream.changed_rows;
      messages.add(line.number, options.keep_changed ? "not the bytes that were recorded; kept"
                                                     : "not the bytes that were recorded; left out");
      if (!options.keep_changed) return;
    }
    ++stream.rows;
    out.append(line.text);
    out += '\n';
  });
  messages.end();
  return out;
}

}  // namespace asperity

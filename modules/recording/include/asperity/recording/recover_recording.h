#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "asperity/base/progress.h"
#include "asperity/json/json.h"
#include "asperity/recording/read_limits.h"

namespace asperity {

struct RecoverOptions {
  std::filesystem::path like;  // a recording whose recording.json and calibration.json stand in for unreadable ones
  bool keep_changed = false;   // keep the rows whose bytes are not those that were recorded, too
};

// What became of one stream.
struct RecoveredStream {
  std::string file;
  bool found = false;                 // the file was there and had a header, or rows that show which it was
  bool checked = false;               // checksums.txt lists blocks of it
  std::size_t rows = 0;               // saved
  std::size_t changed_rows = 0;       // not the bytes that were recorded: left out, or kept if asked for
  std::size_t unreadable_rows = 0;    // no rows of this stream: left out
  bool rows_missing = false;          // rows that were recorded are not there, how many is not known
  bool header_replaced = false;       // the header was unreadable; the one of as many columns was put in its place
  std::vector<std::string> messages;  // where, a line each
};

// Its counts, as extra.recovered of recording.json has them.
Json losses_json(const RecoveredStream& stream);

struct RecoveredRecording {
  RecoveredStream probe;
  RecoveredStream tracker;
  std::vector<RecoveredStream> bodies;       // of recording.json's, in its order
  std::vector<std::string> taken_from_like;  // files
  std::vector<std::string> copied;           // files and folders that are as they were

  // By the checksums of all streams: without them nobody knows what is missing.
  bool lost_nothing() const;
};

// Saves what a damaged recording holds: writes into `out`, an existing folder, the rows of probe.csv, tracker.csv
// and the bodies' streams that are whole, byte for byte, with new checksums, and copies truth.csv, camera.json,
// markers.json and frames/. A row is whole if its block's checksum holds, where there is one, and if it has as many
// cells as the header, each a number or empty, and a time. Files of `folder` are only read. recording.json gets
// extra.recovered: what was left out. Throws Error if there is no row to save, or if recording.json or calibration.json
// cannot be read and `like` does not stand in. With recording.json from `like` the bodies are that recording's and
// those whose streams are in `folder`.
RecoveredRecording recover_recording(const std::filesystem::path& folder, const std::filesystem::path& out,
                                     const RecoverOptions& options = {}, const ReadLimits& limits = {},
                                     const Observer& observer = {});

}  // namespace asperity

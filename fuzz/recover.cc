// A damaged recording, its files one behind the other, each after a line "%%%": recording.json, calibration.json,
// probe.csv, tracker.csv, checksums.txt, tracker_object.csv. Recovering refuses with an Error, or saves rows that are
// there, in a folder whose streams agree with their new checksums.
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "asperity/base/csv.h"
#include "asperity/base/error.h"
#include "asperity/recording/recover_recording.h"
#include "block_checksums.h"
#include "fuzz_input.h"

using namespace asperity;

namespace {

// Of this process, in memory where there is such a place; gone at its end.
struct Folder {
  std::string path = std::filesystem::exists("/dev/shm") ? "/dev/shm/recover-XXXXXX" : "/tmp/recover-XXXXXX";
  Folder() { must(::mkdtemp(path.data()) != nullptr); }
  ~Folder() {
    std::error_code error;
    std::filesystem::remove_all(path, error);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  constexpr std::string_view kMark = "%%%\n";
  constexpr std::array<const char*, 6> kNames{"recording.json", "calibration.json", "probe.csv",
                                              "tracker.csv",    kChecksumFile,      "tracker_object.csv"};
  const std::filesystem::path in = folder.path + "/in", out = folder.path + "/out";
  std::filesystem::remove_all(out);
  std::filesystem::create_directories(in);
  std::filesystem::create_directories(out);
  std::string_view rest = fuzz_text(data, size);
  for (const char* name : kNames) {
    const std::size_t end = rest.find(kMark);
    std::ofstream(in / name, std::ios::binary) << rest.substr(0, end);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + kMark.size());
  }
  RecoveredRecording recovered;
  try {
    recovered = recover_recording(in, out);
  } catch (const Error&) {
    return 0;
  }
  const std::string sums = read_file(out / kChecksumFile, 1 << 24);
  std::vector<const RecoveredStream*> streams{&recovered.probe, &recovered.tracker};
  for (const RecoveredStream& body : recovered.bodies) streams.push_back(&body);
  for (const RecoveredStream* stream : streams) {
    if (!std::filesystem::exists(out / stream->file)) continue;
    const std::string saved = read_file(out / stream->file, 1 << 24);
    must(static_cast<std::size_t>(std::count(saved.begin(), saved.end(), '\n')) == stream->rows + 1);
    must(find_changes(saved, parse_checksums(sums, stream->file)).empty());
  }
  return 0;
}

#include "unfinished_output.h"

#include <unistd.h>
#include <algorithm>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asperity/base/output.h"

namespace asperity {

namespace fs = std::filesystem;

namespace {

// Is never destroyed: the thread that waits for signals may come while the program leaves.
template <class Value>
union Lasting {
  Lasting() : value() {}
  ~Lasting() {}  // NOLINT(modernize-use-equals-default): a default one is deleted
  Value value;
};

std::mutex unfinished_mutex;
Lasting<std::set<fs::path>> lasting_unfinished;
std::set<fs::path>& unfinished = lasting_unfinished.value;

// What was put in place, for those who ask what an interrupted program leaves. Guarded by unfinished_mutex.
constexpr std::size_t kMostNamed = 3;
Lasting<std::vector<fs::path>> lasting_in_place;
std::vector<fs::path>& in_place = lasting_in_place.value;
std::size_t in_place_count = 0;
bool is_ending = false;  // what was unfinished is removed, and what was put in place is about to be told

}  // namespace

void mark_unfinished(const fs::path& path) {
  const std::lock_guard lock(unfinished_mutex);
  unfinished.insert(path);
}

void mark_finished(const fs::path& path) noexcept {
  const std::lock_guard lock(unfinished_mutex);
  unfinished.erase(path);
}

bool is_in_unfinished_folder(const fs::path& path) {
  const std::lock_guard lock(unfinished_mutex);
  for (fs::path folder = path.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
    if (unfinished.contains(folder)) return true;
  }
  return false;
}

OutputNote::OutputNote(fs::path path) : path_(std::move(path)) {
  const std::lock_guard lock(unfinished_mutex);
  in_place.reserve(kMostNamed);
}

void OutputNote::make() noexcept {
  const std::lock_guard lock(unfinished_mutex);
  make_locked();
}

void OutputNote::make_locked() noexcept {
  if (std::find(in_place.begin(), in_place.end(), path_) != in_place.end()) return;
  if (in_place.size() < kMostNamed) in_place.push_back(std::move(path_));
  ++in_place_count;
}

PlacingLock::PlacingLock() {
  unfinished_mutex.lock();
  while (is_ending) {
    unfinished_mutex.unlock();
    ::pause();
    unfinished_mutex.lock();
  }
}

PlacingLock::~PlacingLock() { unfinished_mutex.unlock(); }

void PlacingLock::end(const fs::path& temporary, OutputNote* note) const noexcept {
  unfinished.erase(temporary);
  if (note != nullptr) note->make_locked();
}

void note_output(const fs::path& path) { OutputNote(path).make(); }

std::string outputs_in_place() {
  const std::lock_guard lock(unfinished_mutex);
  std::string out;
  for (const fs::path& path : in_place) out += (out.empty() ? "" : ", ") + path.string();
  if (in_place_count > in_place.size()) out += " and others";
  return out;
}

void remove_unfinished_output() {
  const std::lock_guard lock(unfinished_mutex);
  std::error_code ignored;
  for (const auto& path : unfinished) fs::remove_all(path, ignored);
  unfinished.clear();
  is_ending = true;
}

}  // namespace asperity

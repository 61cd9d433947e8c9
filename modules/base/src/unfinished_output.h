#pragma once

#include <filesystem>

namespace asperity {

// What is being written, and what is in place, as the thread knows it that waits for signals (output.h).

// `path` is removed if the program ends before it is finished.
void mark_unfinished(const std::filesystem::path& path);

// Takes no memory: destructors call it.
void mark_finished(const std::filesystem::path& path) noexcept;

// True if `path` lies in a folder that is still being written.
bool is_in_unfinished_folder(const std::filesystem::path& path);

// A note of what is about to be put in place. Its memory is taken before: afterwards none may be left, and what is
// there must be told all the same.
class OutputNote {
 public:
  explicit OutputNote(std::filesystem::path path);
  void make() noexcept;

 private:
  friend class PlacingLock;
  void make_locked() noexcept;  // by who holds the mutex

  std::filesystem::path path_;
};

// Held while something is put in place: over the renames, the end of its mark as unfinished, and its note. The
// thread that waits for signals removes what is unfinished and tells what is in place under the same mutex, so that it
// sees all of this or nothing: it never says that nothing was written where something is, and never removes a folder
// that was replaced, which has the temporary name after an exchange. Once it has removed, whoever comes here waits for
// the program's end, or what it is about to say would be false.
//
// It cannot come to a deadlock: whoever holds the mutex locks nothing else, waits for nothing and calls nobody, but
// renames or removes, which ends unless the disk hangs. On such a disk SIGKILL alone ends the program. Who waits for
// the program's end does not hold it. What is done under this lock takes no memory: it cannot end halfway by the lack
// of it.
class PlacingLock {
 public:
  PlacingLock();
  ~PlacingLock();
  PlacingLock(const PlacingLock&) = delete;
  PlacingLock& operator=(const PlacingLock&) = delete;

  // What is in place is not unfinished any more; the note, unless it is null, is made.
  void end(const std::filesystem::path& temporary, OutputNote* note) const noexcept;
};

}  // namespace asperity

#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace asperity {

// Hands immutable snapshots from any thread to one reader, the servo thread, by an exchange of pointers. The reader
// neither waits, locks, allocates nor frees: what it has put aside is freed by the next publish() or at the end.
template <class T>
class SnapshotExchange {
 public:
  explicit SnapshotExchange(std::unique_ptr<T> first) : current_(first.release()) {}
  SnapshotExchange(const SnapshotExchange&) = delete;
  SnapshotExchange& operator=(const SnapshotExchange&) = delete;
  ~SnapshotExchange();

  // Any thread but the reader's. The reader sees it at its next acquire().
  void publish(std::unique_ptr<T> next);

  // The reader's thread alone: the newest snapshot, valid until its next acquire(). Never null.
  T* acquire() noexcept;

 private:
  T* current_;                        // the reader's
  std::atomic<T*> pending_{nullptr};  // published, not yet taken
  std::atomic<T*> retired_{nullptr};  // put aside by the reader, to be freed by a publisher
  std::mutex publishers_;
};

}  // namespace asperity

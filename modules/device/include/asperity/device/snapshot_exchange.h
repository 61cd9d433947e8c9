#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

#include "asperity/base/error.h"

namespace asperity {

// Hands immutable snapshots from any thread to one reader, the servo thread, by an exchange of pointers. The reader
// neither waits, locks, allocates nor frees: what it has put aside is freed by the next publish() or at the end.
//
// There is one place for what is published and one for what was put aside. The reader takes a snapshot only while
// the second place is empty, and fills the second before it empties the first; a publisher fills the first, then
// empties the second. So, once publish() has returned, nothing keeps the reader from the new snapshot: the second place
// can be full again only by an acquire() that goes on to take it.
template <class T>
class SnapshotExchange {
 public:
  // Throws Error without a first snapshot.
  explicit SnapshotExchange(std::unique_ptr<T> first) : current_(not_null(std::move(first)).release()) {}
  SnapshotExchange(const SnapshotExchange&) = delete;
  SnapshotExchange& operator=(const SnapshotExchange&) = delete;
  ~SnapshotExchange() {
    delete current_;
    delete pending_.load();
    delete retired_.load();
  }

  // Any thread but the reader's. The reader sees it at its next acquire(), at the latest the first one after this
  // has returned. A snapshot that was published before and never taken is freed. Throws Error for none.
  // Thread-safe: yes. Realtime-safe: no.
  void publish(std::unique_ptr<T> next) {
    T* const fresh = not_null(std::move(next)).release();
    const std::lock_guard lock(publishers_);
    delete pending_.exchange(fresh, std::memory_order_acq_rel);
    delete retired_.exchange(nullptr, std::memory_order_acq_rel);
  }

  // The reader's thread alone: the newest snapshot, valid until its next acquire(). Never null.
  // Realtime-safe: yes.
  T* acquire() noexcept {
    if (pending_.load(std::memory_order_relaxed) == nullptr) return current_;
    if (retired_.load(std::memory_order_acquire) != nullptr) return current_;
    // Put aside first: the other way round a whole publish() fits between, finds nothing to free, and its snapshot
    // would wait behind the one put aside after it. From here the old one may be freed at any time.
    retired_.store(current_, std::memory_order_release);
    // A publisher may have exchanged it for a newer one since, but never for none.
    current_ = pending_.exchange(nullptr, std::memory_order_acq_rel);
    return current_;
  }

 private:
  static std::unique_ptr<T> not_null(std::unique_ptr<T> snapshot) {
    if (!snapshot) throw Error("a snapshot exchange was given no snapshot");
    return snapshot;
  }

  T* current_;                        // the reader's
  std::atomic<T*> pending_{nullptr};  // published, not yet taken
  std::atomic<T*> retired_{nullptr};  // put aside by the reader, to be freed by a publisher
  std::mutex publishers_;
};

}  // namespace asperity

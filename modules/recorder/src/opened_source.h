#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "asperity/base/error.h"
#include "asperity/recorder/recorder_snapshot.h"
#include "bounded_queue.h"
#include "sensor_thread.h"

namespace asperity {

// A sensor's source that can be opened anew. One thread at a time.
template <class Source>
class OpenedSource {
 public:
  // Opens it; throws Error if that fails. `sensor` names it in messages.
  OpenedSource(std::function<std::unique_ptr<Source>()> open, const std::string& sensor)
      : open_(std::move(open)), source_(open_()) {
    if (!source_) throw Error("recorder: the " + sensor + " could not be opened");
    name_ = source_->name();
  }

  void open_again() {
    source_ = open_();
    if (!source_) throw Error(name_ + ": cannot be opened");
  }
  void close() noexcept { source_.reset(); }
  Source* operator->() { return source_.get(); }
  const std::string& name() const { return name_; }  // as when it was opened first

 private:
  std::function<std::unique_ptr<Source>()> open_;
  std::unique_ptr<Source> source_;
  std::string name_;
};

// What a thread and its queue say of themselves; the name, the warnings and the rate are others' to tell.
inline void describe_sensor(const SensorThread::Health& health, const QueueCounts& queue, SensorSnapshot& out) {
  out.state = health.state;
  out.message = health.message;
  out.failed = health.failed;
  out.lost = health.lost;
  out.returned = health.returned;
  out.queue_fill = queue.fill;
  out.highest_queue_fill = queue.highest_fill;
  out.overflowed = queue.overflowed;
  out.received = queue.received;
}

}  // namespace asperity

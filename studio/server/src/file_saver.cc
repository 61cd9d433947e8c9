#include "file_saver.h"

#include <chrono>
#include <exception>
#include <utility>

#include "asperity/base/output.h"

namespace asperity::studio {

FileSaver::FileSaver(std::filesystem::path file, std::function<void(std::string)> failed)
    : file_(std::move(file)), failed_(std::move(failed)), thread_([this] { run(); }) {}

FileSaver::~FileSaver() { finish(); }

std::string FileSaver::finish() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  woken_.notify_one();
  if (thread_.joinable()) thread_.join();
  return lost_;
}

void FileSaver::save(std::string content) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(content);
  }
  woken_.notify_one();
}

void FileSaver::run() {
  constexpr std::chrono::seconds kTryAgainAfter{2};
  std::optional<std::string> unwritten;
  bool tried_at_the_end = false;
  for (;;) {
    bool last = false;
    {
      std::unique_lock lock(mutex_);
      const auto woken = [this] { return ending_ || waiting_; };
      if (unwritten) {
        woken_.wait_for(lock, kTryAgainAfter, woken);
      } else {
        woken_.wait(lock, woken);
      }
      last = ending_;
      if (waiting_) unwritten = std::exchange(waiting_, std::nullopt);
      if (!unwritten) return;
    }
    try {
      write_file(file_, *unwritten);
      unwritten.reset();
    } catch (const std::exception& error) {
      failed_(error.what());
      // The first try may have begun before the end: what fails then has one more.
      if (!last || !std::exchange(tried_at_the_end, true)) continue;
      lost_ = error.what();
      return;
    }
  }
}

}  // namespace asperity::studio

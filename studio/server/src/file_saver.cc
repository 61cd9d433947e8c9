#include "file_saver.h"

#include <exception>
#include <utility>

#include "asperity/base/output.h"

namespace asperity::studio {

FileSaver::FileSaver(std::filesystem::path file, std::function<void(std::string)> failed)
    : file_(std::move(file)), failed_(std::move(failed)), thread_([this] { run(); }) {}

FileSaver::~FileSaver() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  woken_.notify_one();
  thread_.join();
}

void FileSaver::save(std::string content) {
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(content);
  }
  woken_.notify_one();
}

void FileSaver::run() {
  for (;;) {
    std::optional<std::string> content;
    {
      std::unique_lock lock(mutex_);
      woken_.wait(lock, [this] { return ending_ || waiting_; });
      if (!waiting_) return;
      content = std::exchange(waiting_, std::nullopt);
    }
    try {
      write_file(file_, *content);
    } catch (const std::exception& error) {
      failed_(error.what());
    }
  }
}

}  // namespace asperity::studio

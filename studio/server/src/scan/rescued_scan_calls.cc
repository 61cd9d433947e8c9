#include "scan/rescued_scan_calls.h"

#include <memory>
#include <utility>

namespace asperity::studio {

void RescuedScanCalls::bind(Calls& calls) {
  calls.add("scan.rescued", [this](const Request& request) {
    Json out;
    out["recording"] = rescued_ ? Json(rescued_->recording) : Json();
    out["duration_s"] = rescued_ ? rescued_->duration_s : 0.0;
    out["problem"] = rescued_ ? rescued_->problem : "";
    request.answer(out);
  });
  calls.add("scan.forget_rescued", [this](const Request& request) {
    rescued_.reset();
    request.done();
    shared_.hub.broadcast("rescued", Json::object());
  });
}

// Once read it is in the memory of this studio, and the note is free for the next scan.
void RescuedScanCalls::start() {
  auto found = std::make_shared<std::optional<RescuedScan>>();
  shared_.jobs.start_in(
      "scan", "", "",
      [found, folder = shared_.project.folder()](const Observer&) {
        *found = find_rescued_scan(folder);
        forget_open_scan(folder);
      },
      [this, found](std::exception_ptr) {
        rescued_ = std::move(*found);
        if (rescued_) shared_.hub.broadcast("rescued", Json::object());
      });
}

}  // namespace asperity::studio

#include "asperity/batch/run_batch.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "asperity/base/error.h"

namespace asperity {

std::vector<ScanOutcome> run_batch(const BatchPlan& plan, const std::vector<BatchScan>& scans,
                                   const std::string& output, const std::filesystem::path& program, int jobs,
                                   const Observer& observer, const std::function<void(const ScanOutcome&)>& ended) {
  std::vector<ScanOutcome> out(scans.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stopped{false};
  std::mutex reporting;
  std::size_t count = 0;
  const Observer asked{{}, [&] { return stopped || (observer.cancelled && observer.cancelled()); }};

  const auto work = [&] {
    for (std::size_t i = next++; i < scans.size() && !asked.cancelled(); i = next++) {
      try {
        out[i] = run_scan(plan, scans[i], output, program, asked);
      } catch (const Cancelled&) {
        stopped = true;
        return;
      } catch (const std::exception& error) {
        out[i].was_up_to_date = false;
        out[i].record = {scans[i].name, scans[i].path, {{"batch", {}, "", 1, error.what()}}};
      }
      const std::lock_guard lock(reporting);
      ++count;
      if (ended) ended(out[i]);
      if (observer.progress) observer.progress("scans", static_cast<double>(count) / static_cast<double>(scans.size()));
    }
  };
  std::vector<std::thread> workers;
  const auto most = static_cast<int>(std::min<std::size_t>(scans.size(), static_cast<std::size_t>(std::max(jobs, 1))));
  workers.reserve(static_cast<std::size_t>(most));
  for (int i = 0; i < most; ++i) workers.emplace_back(work);
  for (std::thread& worker : workers) worker.join();
  if (asked.cancelled()) throw Cancelled();
  return out;
}

}  // namespace asperity

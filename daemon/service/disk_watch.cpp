#include "daemon/service/disk_watch.h"

#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <utility>

#include "daemon/base/disk_space.h"
#include "daemon/base/service_folders.h"
#include "daemon/service/metrics_file.h"
#include "drivers/clock.h"

namespace mocap {

DiskFindings RunErrand(const DiskErrand& errand) {
  DiskFindings findings;
  findings.bytes_free = BytesFree(errand.takes);
  findings.takes_place = NearestFolder(errand.takes);
  if (access(findings.takes_place.c_str(), W_OK | X_OK) != 0) {
    const char* const why = std::strerror(errno);
    std::error_code error;
    const bool is_there = findings.takes_place == std::filesystem::absolute(errand.takes, error);
    findings.takes_problem = (is_there ? "" : findings.takes_place.string() + ": ") + why;
  }
  if (!errand.background.empty()) findings.background_made_s = WrittenAt(errand.background);
  for (const CutOffTake& take : errand.cut_off) {
    std::error_code error;
    if (std::filesystem::exists(take.folder, error)) findings.cut_off.push_back(take);
  }
  if (!errand.metrics.empty()) {
    findings.could_write_metrics = WriteMetrics(errand.metrics, errand.metrics_text);
  }
  return findings;
}

struct DiskWatch::Shared {
  std::mutex mutex;
  std::condition_variable news;
  std::optional<DiskErrand> next;
  std::optional<DiskFindings> findings;
  bool is_over = false;
  std::int64_t begun_ns = 0;  ///< 0: none is running.
};

DiskWatch::DiskWatch(Run run)
    : shared_(std::make_shared<Shared>()),
      thread_([shared = shared_, run = std::move(run)] { Work(shared, run); }) {}

DiskWatch::~DiskWatch() {
  constexpr std::chrono::milliseconds kUsual{200};
  std::unique_lock lock(shared_->mutex);
  shared_->is_over = true;
  shared_->news.notify_all();
  const bool ends = shared_->news.wait_for(lock, kUsual, [this] { return shared_->begun_ns == 0; });
  lock.unlock();
  ends ? thread_.join() : thread_.detach();
}

void DiskWatch::Send(DiskErrand errand) {
  {
    const std::scoped_lock lock(shared_->mutex);
    // Metrics are written rarely, so an errand without any does not discard them.
    if (shared_->next && errand.metrics.empty()) {
      errand.metrics = shared_->next->metrics;
      errand.metrics_text = shared_->next->metrics_text;
    }
    shared_->next = std::move(errand);
  }
  shared_->news.notify_all();
}

std::optional<DiskFindings> DiskWatch::Findings() const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->findings;
}

std::int64_t DiskWatch::UnderWayNs(std::int64_t now_ns) const {
  const std::scoped_lock lock(shared_->mutex);
  return shared_->begun_ns == 0 ? 0 : now_ns - shared_->begun_ns;
}

void DiskWatch::WaitForFindings(std::int64_t most_ns) const {
  std::unique_lock lock(shared_->mutex);
  shared_->news.wait_for(lock, std::chrono::nanoseconds(most_ns),
                         [this] { return shared_->findings.has_value(); });
}

void DiskWatch::Work(const std::shared_ptr<Shared>& shared, const Run& run) {
  pthread_setname_np(pthread_self(), "disk watch");
  bool could_write_metrics = true;
  std::unique_lock lock(shared->mutex);
  for (;;) {
    shared->news.wait(lock, [&] { return shared->is_over || shared->next; });
    if (shared->is_over) return;
    const DiskErrand errand = std::move(*shared->next);
    shared->next.reset();
    shared->begun_ns = SteadyNs();
    lock.unlock();
    DiskFindings findings = run(errand);
    if (errand.metrics.empty()) findings.could_write_metrics = could_write_metrics;
    could_write_metrics = findings.could_write_metrics;
    lock.lock();
    shared->findings = std::move(findings);
    shared->begun_ns = 0;
    shared->news.notify_all();
  }
}

}  // namespace mocap

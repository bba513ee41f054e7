#include "daemon/service/service_log.h"

#include <spdlog/async.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "daemon/base/service_folders.h"
#include "daemon/service/printable_log.h"
#include "drivers/clock.h"

namespace mocap {
namespace {

constexpr std::size_t kLogBytes = 4'000'000;
constexpr std::size_t kLogFiles = 4;
constexpr std::size_t kMessagesWaiting = 1024;
constexpr std::int64_t kNewsNs = 60'000'000'000;
constexpr std::int64_t kNever = -kNewsNs;

}  // namespace

ServiceLog::ServiceLog() : failed_ns_(std::make_shared<std::atomic<std::int64_t>>(kNever)) {
  std::vector<spdlog::sink_ptr> sinks = {std::make_shared<spdlog::sinks::stderr_color_sink_mt>()};
  sinks[0]->set_formatter(PrintableLogFormat("%n: %^%l%$: %*"));
  std::string problem;
  if (const std::filesystem::path folder = LogsFolder(); !folder.empty()) {
    try {
      sinks.push_back(std::make_shared<spdlog::sinks::rotating_file_sink_mt>(folder / "mocapd.log",
                                                                             kLogBytes, kLogFiles));
      sinks[1]->set_formatter(PrintableLogFormat("%Y-%m-%d %T.%e %l: %*"));
    } catch (const spdlog::spdlog_ex& error) {
      lacks_file_ = true;
      problem = error.what();
    }
  }
  spdlog::init_thread_pool(kMessagesWaiting, 1);
  auto logger = std::make_shared<spdlog::async_logger>(
      "mocapd", sinks.begin(), sinks.end(), spdlog::thread_pool(),
      spdlog::async_overflow_policy::overrun_oldest);
  logger->flush_on(spdlog::level::info);
  // Otherwise spdlog would report it on standard error every second.
  logger->set_error_handler(
      [failed_ns = failed_ns_](const std::string&) { failed_ns->store(SteadyNs()); });
  spdlog::set_default_logger(std::move(logger));
  if (!problem.empty()) spdlog::warn("there is no log file: {}", problem);
}

// Writes what is queued before the program's last words.
ServiceLog::~ServiceLog() { spdlog::shutdown(); }

bool ServiceLog::Fails(std::int64_t now_ns) const {
  return lacks_file_ || now_ns - failed_ns_->load() < kNewsNs;
}

}  // namespace mocap

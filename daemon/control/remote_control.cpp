#include "daemon/control/remote_control.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>

#include "core/errors.h"
#include "daemon/base/other_program.h"
#include "drivers/printable_text.h"

namespace mocap {
namespace {

/// Limit for quoting another computer's output.
constexpr std::size_t kMostCharactersTold = 200;

std::string Seconds(std::chrono::milliseconds time) {
  return fmt::format("{:g} s", static_cast<double>(time.count()) / 1e3);
}

/// The command's own words are best: ssh's last line tells what to fix.
std::string InItsWords(const ProgramRun& run, const std::string& otherwise) {
  return run.last_words.empty() ? otherwise : Shortened(run.last_words, kMostCharactersTold);
}

/// For a run whose output is not a reply.
std::string WhyNoReply(const ProgramRun& run) {
  if (run.output.empty()) return InItsWords(run, "gave no answer");
  const std::string first_line = run.output.substr(0, run.output.find('\n'));
  return "its answer is not a valid reply: \"" + Shortened(first_line, kMostCharactersTold) + '"';
}

std::string WhyItFailed(const ProgramRun& run, const std::string& program,
                        std::chrono::milliseconds patience) {
  switch (run.end) {
    case ProgramRun::End::kNotStarted:
      return program + " cannot be started: " + std::strerror(run.number);
    case ProgramRun::End::kDeadlinePassed:
      return "has not answered for " + Seconds(patience) +
             (run.last_words.empty() ? "" : ": " + InItsWords(run, ""));
    case ProgramRun::End::kSaidTooMuch:
      return "its answer is longer than " + std::to_string(kLongestReply) + " bytes";
    case ProgramRun::End::kKilledBySignal:
      return program + " was killed by signal " + std::to_string(run.number);
    case ProgramRun::End::kExited:
      break;
  }
  return InItsWords(run, program + " ended with status " + std::to_string(run.number));
}

}  // namespace

RemoteControl::RemoteControl(std::string node, std::vector<std::string> command)
    : node_(std::move(node)), command_(std::move(command)) {
  MOCAP_CHECK(!command_.empty());
}

RemoteAnswer RemoteControl::Ask(const std::string& request,
                                std::chrono::milliseconds patience) const {
  MOCAP_CHECK(request.size() <= kLongestRequest);
  const ProgramRun run =
      RunOtherProgram(command_, request, {.patience = patience, .longest_output = kLongestReply});
  // A connection that broke during a reply leaves a part of it, and a nonzero status.
  if (run.end != ProgramRun::End::kExited || run.number != 0)
    return {{}, node_ + ": " + WhyItFailed(run, command_[0], patience)};
  std::optional<ControlReply> reply = DecodeReply(run.output);
  if (!reply) return {{}, node_ + ": " + WhyNoReply(run)};
  return {std::move(reply), {}};
}

std::future<RemoteAnswer> RemoteControl::AskBeside(std::string request,
                                                   std::chrono::milliseconds patience) const {
  return std::async(std::launch::async, [asked = *this, request = std::move(request), patience] {
    return asked.Ask(request, patience);
  });
}

}  // namespace mocap

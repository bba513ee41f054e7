#include "daemon/control/control_request.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

namespace mocap {
namespace {

constexpr std::size_t kLongestName = 64;
constexpr std::array<std::string_view, 3> kOutcomeNames = {"done", "failed", "wrong"};

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const std::size_t space = std::min(line.find(' '), line.size());
    words.push_back(line.substr(0, space));
    line.remove_prefix(std::min(space + 1, line.size()));
  }
  return words;
}

template <typename Request>
std::optional<ControlRequest> Named(std::string_view name) {
  if (!IsFileName(name)) return {};
  return Request{std::string(name)};
}

std::optional<ControlRequest> SaveOf(std::string_view name, std::string_view number) {
  int person = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), person);
  const bool is_number = error == std::errc() && end == number.data() + number.size();
  if (!IsFileName(name) || !is_number || person < 1) return {};
  return SubjectSaveRequest{std::string(name), person};
}

std::optional<ControlRequest> OccupiedOf(std::string_view seconds, std::string_view accepted) {
  BackgroundOccupiedRequest request;
  const auto [end, error] =
      std::from_chars(seconds.data(), seconds.data() + seconds.size(), request.seconds);
  const bool is_number = error == std::errc() && end == seconds.data() + seconds.size();
  if (!is_number || !(request.seconds >= 1 && request.seconds <= kLongestOccupied_s)) return {};
  while (!accepted.empty()) {
    const std::size_t comma = std::min(accepted.find(','), accepted.size());
    if (!IsFileName(accepted.substr(0, comma))) return {};
    request.accepted.emplace_back(accepted.substr(0, comma));
    accepted.remove_prefix(std::min(comma + 1, accepted.size()));
  }
  return request;
}

std::optional<ControlRequest> WithoutName(const std::string_view first,
                                          const std::string_view second) {
  if (first == "record" && second == "stop") return RecordStopRequest{};
  if (first == "subject" && second == "new") return SubjectNewRequest{};
  if (first == "subject" && second == "list") return SubjectListRequest{};
  if (first == "background" && second == "learn") return BackgroundLearnRequest{};
  if (first == "background" && second == "result") return BackgroundResultRequest{};
  if (first == "background" && second == "status") return BackgroundStatusRequest{};
  if (first == "status" && second == "json") return StatusRequest{.as_json = true};
  return {};
}

}  // namespace

bool IsFileName(std::string_view name) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  return !name.empty() && name.size() <= kLongestName && name[0] != '.' && name[0] != '-' &&
         !name.ends_with(".partial") && std::ranges::all_of(name, is_allowed);
}

std::optional<ControlRequest> ParseControlRequest(std::string_view line) {
  if (line.size() > kLongestRequest) return {};
  if (line.ends_with('\n')) line.remove_suffix(1);
  const std::vector<std::string_view> words = Words(line);
  if (words.size() == 1 && words[0] == "status") return StatusRequest{};
  if (words.size() == 1 && words[0] == "reload") return ReloadRequest{};
  if (words.size() == 1 && words[0] == "look") return LookRequest{};
  if (words.size() == 2) return WithoutName(words[0], words[1]);
  if (words.size() == 4 && words[0] == "subject" && words[1] == "save") {
    return SaveOf(words[2], words[3]);
  }
  const bool is_occupied = words.size() >= 3 && words[0] == "background" && words[1] == "occupied";
  if (is_occupied && words.size() <= 4)
    return OccupiedOf(words[2], words.size() == 4 ? words[3] : std::string_view());
  if (words.size() != 3) return {};
  if (words[0] == "background" && words[1] == "learn" && words[2] == "anyway") {
    return BackgroundLearnRequest{.anyway = true};
  }
  if (words[0] == "record" && words[1] == "start") return Named<RecordStartRequest>(words[2]);
  if (words[0] == "record" && words[1] == "cancel") return Named<RecordCancelRequest>(words[2]);
  if (words[0] == "subject" && words[1] == "save") return Named<SubjectSaveRequest>(words[2]);
  if (words[0] == "subject" && words[1] == "load") return Named<SubjectLoadRequest>(words[2]);
  return {};
}

std::string EncodeReply(const ControlReply& reply) {
  std::string message(kOutcomeNames[static_cast<std::size_t>(reply.outcome)]);
  message += '\n';
  message += reply.text;
  message.resize(std::min(message.size(), kLongestReply));
  return message;
}

std::optional<ControlReply> DecodeReply(std::string_view message) {
  const std::size_t end = message.find('\n');
  if (end == std::string_view::npos) return {};
  const auto name = std::ranges::find(kOutcomeNames, message.substr(0, end));
  if (name == kOutcomeNames.end()) return {};
  return ControlReply{static_cast<ControlOutcome>(name - kOutcomeNames.begin()),
                      std::string(message.substr(end + 1))};
}

}  // namespace mocap

// Requests to the running daemon: one line of words each.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace mocap {

struct StatusRequest {
  bool as_json = false;
};
struct ReloadRequest {};
struct RecordStartRequest {
  std::string name;
};
struct RecordStopRequest {};
struct SubjectNewRequest {};
struct SubjectSaveRequest {
  std::string name;
  std::optional<int> person = {};  ///< Whose sizes, by number; empty: of the only one.
};
struct SubjectLoadRequest {
  std::string name;
};
struct SubjectListRequest {};
struct BackgroundLearnRequest {
  bool anyway = false;  ///< Also where somebody is believed to be in the room.
};
struct BackgroundStatusRequest {};
/// Somebody looks: pictures and voxels are wanted for the next seconds.
struct LookRequest {};

using ControlRequest =
    std::variant<StatusRequest, ReloadRequest, RecordStartRequest, RecordStopRequest,
                 SubjectNewRequest, SubjectSaveRequest, SubjectLoadRequest, SubjectListRequest,
                 BackgroundLearnRequest, BackgroundStatusRequest, LookRequest>;

/// How it went, with the exit status of a program that asked.
enum class ControlOutcome { kDone = 0, kFailed = 1, kWrong = 2 };

struct ControlReply {
  ControlOutcome outcome = ControlOutcome::kDone;
  std::string text;  ///< For people, or JSON where that was asked for.
};

/// Longer requests and replies are refused.
inline constexpr std::size_t kLongestRequest = 512;
inline constexpr std::size_t kLongestReply = 65536;

/// Understands "status [json]", "reload", "record start NAME", "record stop", "subject new",
/// "subject save NAME [NUMBER]", "subject load NAME", "subject list", "background learn [anyway]",
/// "background status" and "look"; empty for anything else.
std::optional<ControlRequest> ParseControlRequest(std::string_view line);

/// Names become files: letters, digits, dots, underscores and hyphens. They do not begin with a dot
/// or hyphen, nor end in ".partial", which marks takes that are not complete.
bool IsFileName(std::string_view name);

/// A reply as it is sent: "done", "failed" or "wrong", a line's end, the text.
std::string EncodeReply(const ControlReply& reply);
/// Empty when it is none.
std::optional<ControlReply> DecodeReply(std::string_view message);

}  // namespace mocap

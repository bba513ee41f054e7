// Requests to the running daemon: one line of words each.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace mocap {

struct StatusRequest {
  bool as_json = false;
};
struct ReloadRequest {};
struct RecordStartRequest {
  std::string name;
};
struct RecordStopRequest {};
/// From a studio whose other computers could not start the same take.
struct RecordCancelRequest {
  std::string name;
};
struct SubjectNewRequest {};
struct SubjectSaveRequest {
  std::string name;
  std::optional<int> person = {};  ///< Number of the person; empty: the only one.
};
struct SubjectLoadRequest {
  std::string name;
};
struct SubjectListRequest {};
struct BackgroundLearnRequest {
  bool anyway = false;  ///< Even if somebody seems to be in the room.
};
/// Begins to learn from people who move about.
struct BackgroundOccupiedRequest {
  double seconds = 0;
  std::vector<std::string> accepted = {};  ///< Cameras in which moved things are accepted.
};
/// What it does at present, or what was learned.
struct BackgroundResultRequest {};
struct BackgroundStatusRequest {};
/// A viewer wants pictures and voxels for the next seconds.
struct LookRequest {};

using ControlRequest =
    std::variant<StatusRequest, ReloadRequest, RecordStartRequest, RecordStopRequest,
                 RecordCancelRequest, SubjectNewRequest, SubjectSaveRequest, SubjectLoadRequest,
                 SubjectListRequest, BackgroundLearnRequest, BackgroundOccupiedRequest,
                 BackgroundResultRequest, BackgroundStatusRequest, LookRequest>;

/// The outcome, with the exit status for a program that asked.
enum class ControlOutcome { kDone = 0, kFailed = 1, kWrong = 2 };

struct ControlReply {
  ControlOutcome outcome = ControlOutcome::kDone;
  /// For people, or JSON if requested. Of a failure, the last line says what failed, and lines
  /// before it what was done nevertheless.
  std::string text;
};

/// Longest recording of people who move about [s].
inline constexpr double kLongestOccupied_s = 600;

/// Longer requests and replies are refused.
inline constexpr std::size_t kLongestRequest = 512;
inline constexpr std::size_t kLongestReply = 65536;

/// Parses "status [json]", "reload", "record start NAME", "record stop", "record cancel NAME",
/// "subject new", "subject save NAME [NUMBER]", "subject load NAME", "subject list", "background
/// learn [anyway]", "background occupied SECONDS [CAMERA,…]", "background result", "background
/// status" and "look"; empty for anything else.
std::optional<ControlRequest> ParseControlRequest(std::string_view line);

/// Whether a name can be a file name: letters, digits, dots, underscores and hyphens. It must not
/// begin with a dot or hyphen, or end in ".partial", which marks incomplete takes.
bool IsFileName(std::string_view name);

/// The reply on the wire: "done", "failed" or "wrong", a newline, the text.
std::string EncodeReply(const ControlReply& reply);
/// Empty if it is not a reply.
std::optional<ControlReply> DecodeReply(std::string_view message);

}  // namespace mocap

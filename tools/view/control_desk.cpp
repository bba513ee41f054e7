#include "tools/view/control_desk.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "daemon/base/json.h"
#include "daemon/control/control_request.h"
#include "daemon/control/control_socket.h"
#include "tools/view/access.h"

namespace mocap {
namespace {

constexpr const char* kJson = "application/json";
constexpr std::array<std::string_view, 3> kOutcomes = {"done", "failed", "wrong"};

/// Whether the page may send this request: only what a person does.
bool IsOffered(const std::string& line) {
  const std::optional<ControlRequest> request = ParseControlRequest(line);
  return request && !std::holds_alternative<StatusRequest>(*request) &&
         !std::holds_alternative<LookRequest>(*request);
}

ViewReply Wrong(const std::string& why) {
  return {400, kJson, JsonText({{"outcome", "wrong"}, {"text", why}})};
}

}  // namespace

ControlDesk::ControlDesk(std::filesystem::path socket, std::string token)
    : socket_(std::move(socket)), token_(std::move(token)) {}

ViewReply ControlDesk::Answer(const ViewRequest& request) const {
  if (request.path != "/control") return {404, "", ""};
  if (!HoldsToken(request.authorization, token_)) {
    return {401, kJson,
            JsonText({{"outcome", "wrong"}, {"text", "the token is missing or wrong"}})};
  }
  if (request.method == "GET") return {204, "", ""};
  const nlohmann::json body = nlohmann::json::parse(request.body, nullptr, false);
  const bool is_request =
      body.is_object() && body.contains("request") && body["request"].is_string();
  if (!is_request) return Wrong("expected {\"request\": \"…\"}");
  const std::string line = body["request"];
  if (!IsOffered(line)) return Wrong("the page may not make this request");
  const ControlReply reply = ReplyOfDaemon(socket_, line);
  return {200, kJson,
          JsonText({{"outcome", kOutcomes[static_cast<std::size_t>(reply.outcome)]},
                    {"text", reply.text}})};
}

std::string ControlDesk::Look() const {
  const ControlReply reply = ReplyOfDaemon(socket_, "look");
  return reply.outcome == ControlOutcome::kDone ? "" : reply.text;
}

}  // namespace mocap

#include "daemon/service/node_requests.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/errors.h"

namespace mocap {
namespace {

constexpr std::chrono::seconds kLookPatience{5};

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Keeps what nodes answered in the studio's log.
void LogAnswers(const std::string& done, const std::string& problem) {
  std::istringstream lines(done);
  for (std::string line; std::getline(lines, line);) spdlog::info("{}", line);
  if (!problem.empty()) spdlog::warn("{}", problem);
}

}  // namespace

NodeRequests::NodeRequests(const std::vector<StudioNode>& nodes) {
  for (const StudioNode& node : nodes) {
    if (node.control.empty()) {
      unreachable_.push_back(node.name);
    } else {
      controls_.emplace_back("node " + node.name, node.control);
    }
  }
}

NodeRequests::Asked NodeRequests::Ask(const std::string& request,
                                      std::chrono::milliseconds patience) const {
  Asked asked;
  for (const RemoteControl& control : controls_) {
    asked.nodes_.push_back(control.node());
    asked.futures_.push_back(control.AskBeside(request, patience));
  }
  for (const std::string& name : unreachable_) {
    asked.nodes_.push_back("node " + name);
    std::promise<RemoteAnswer> refusal;
    refusal.set_value({{},
                       "node " + name +
                           ": [[nodes]] has no control command for it, such as "
                           "[\"ssh\", \"mocap-studio@" +
                           name + "\"]"});
    asked.futures_.push_back(refusal.get_future());
  }
  return asked;
}

NodeRequests::Asked NodeRequests::AskWhoDid(const Answers& before, const std::string& request,
                                            std::chrono::milliseconds patience) const {
  Asked asked;
  for (std::size_t i = 0; i < controls_.size(); ++i) {
    const std::optional<ControlReply>& reply = before.answers[i].reply;
    if (reply && reply->outcome != ControlOutcome::kDone) continue;
    asked.nodes_.push_back(controls_[i].node());
    asked.futures_.push_back(controls_[i].AskBeside(request, patience));
  }
  return asked;
}

NodeRequests::Answers NodeRequests::Asked::Wait() {
  Answers answers{std::move(nodes_), {}};
  for (std::future<RemoteAnswer>& future : futures_) answers.answers.push_back(future.get());
  return answers;
}

std::string NodeRequests::Answers::Problem() const {
  std::string problems;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const RemoteAnswer& answer = answers[i];
    if (answer.reply && answer.reply->outcome == ControlOutcome::kDone) continue;
    problems += problems.empty() ? "" : "; ";
    problems += answer.reply ? nodes[i] + ": " + FirstLine(answer.reply->text) : answer.problem;
  }
  return problems;
}

std::string NodeRequests::Answers::Text() const {
  std::string text;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (!answers[i].reply || answers[i].reply->outcome != ControlOutcome::kDone) continue;
    const std::string& said = answers[i].reply->text;
    for (std::size_t begin = 0; begin < said.size();) {
      const std::size_t end = std::min(said.find('\n', begin), said.size());
      text += nodes[i] + ": " + said.substr(begin, end - begin) + '\n';
      begin = end + 1;
    }
  }
  return text;
}

void NodeRequests::Look() {
  std::erase_if(looks_, [](const std::future<RemoteAnswer>& look) {
    return look.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  });
  if (!looks_.empty()) return;
  for (const RemoteControl& control : controls_)
    looks_.push_back(control.AskBeside("look", kLookPatience));
}

std::string DoEverywhere(NodeRequests::Asked at_nodes,
                         const std::function<std::string()>& do_here) {
  std::string done, problems;
  bool is_wrong = false;
  try {
    done = do_here();
  } catch (const std::exception& error) {
    problems = error.what();
    is_wrong = dynamic_cast<const SetupError*>(&error) != nullptr;
  }
  const NodeRequests::Answers answers = at_nodes.Wait();
  const std::string of_nodes = answers.Problem();
  LogAnswers(answers.Text(), of_nodes);
  if (!problems.empty() && !answers.nodes.empty()) problems = "studio: " + problems;
  problems += (problems.empty() || of_nodes.empty() ? "" : "; ") + of_nodes;
  done += answers.Text();
  if (problems.empty()) return done;
  if (is_wrong) throw SetupError(done + problems);
  throw std::runtime_error(done + problems);
}

std::string CancelTake(NodeRequests::Asked at_nodes, const std::function<void()>& cancel_here) {
  std::string problems;
  try {
    cancel_here();
  } catch (const std::exception& error) {
    problems = std::string("; studio: ") + error.what();
  }
  if (const std::string problem = at_nodes.Wait().Problem(); !problem.empty())
    problems += "; " + problem;
  return problems.empty() ? "nothing is recorded"
                          : "a part of the take may be left, as not all could cancel it" + problems;
}

}  // namespace mocap

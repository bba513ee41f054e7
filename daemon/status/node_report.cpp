#include "daemon/status/node_report.h"

#include <fmt/format.h>

#include "drivers/printable_text.h"

namespace mocap {
namespace {

std::string ClockText(const NodeReport& node) {
  if (!node.clock_agrees)
    return fmt::format("{:+.1f} ms", -static_cast<double>(node.clock_apart_ns) / 1e6);
  if (node.has_this_clock) return "this one";
  if (!node.clock_is_kept) return "not kept";
  return (node.clock_keeper.empty() ? "kept" : Printable(node.clock_keeper)) +
         fmt::format(" {:.1f} ms", node.clock_error_ms);
}

}  // namespace

std::string NodeTable(const NodesReport& report) {
  if (report.nodes.empty()) return {};
  std::string text =
      fmt::format("{:<16}{:<10}{:>20}{:>12}{:>10}{:>12}{:>12}  {}\n", "node", "state", "clock",
                  "received", "lost", "way ms", "KB a frame", "version");
  for (const NodeReport& node : report.nodes) {
    text += fmt::format("{:<16}{:<10}{:>20}{:>12}{:>10}{:>12.2f}{:>12.1f}  {}\n",
                        Printable(node.name), IsSilent(node) ? "silent" : "heard",
                        node.was_heard ? ClockText(node) : "-", node.received, node.lost,
                        node.transit_p50_ms, node.bytes_per_frame / 1000, Printable(node.version));
  }
  return text + '\n';
}

JsonObject NodeJson(const NodeReport& node) {
  JsonObject json;
  json.Add("name", node.name);
  json.Add("heard", !IsSilent(node));
  json.Add("version", node.version);
  json.Add("has_this_clock", node.has_this_clock);
  json.Add("clock_agrees", node.clock_agrees);
  json.Add("clock_ahead_ms", -static_cast<double>(node.clock_apart_ns) / 1e6, 3);
  json.Add("clock_keeper", node.clock_keeper);
  json.Add("clock_is_kept", node.clock_is_kept);
  json.Add("clock_error_ms", node.clock_error_ms, 3);
  json.Add("received", node.received);
  json.Add("lost", node.lost);
  json.Add("lost_share", node.lost_share, 5);
  json.Add("transit_p50_ms", node.transit_p50_ms, 3);
  json.Add("transit_p99_ms", node.transit_p99_ms, 3);
  json.Add("bytes_per_frame", node.bytes_per_frame, 0);
  json.Add("complaints", node.complaints);
  return json;
}

}  // namespace mocap

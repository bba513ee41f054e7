// Common parts of logs of LCM messages: channels with prefixes, and skipped messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/messages/log_reader.h"

namespace mocap {

/// Reads the messages of some channels from a log of lcm-logger.
class ChannelLog {
 public:
  /// @param names   of the channels, without prefix, the main one first. None may be the end of
  /// another.
  ///                They must outlive this object.
  /// @param prefix  of the wanted messages. Empty: any.
  /// @throws SetupError  when the file cannot be read.
  ChannelLog(const std::filesystem::path& log, std::vector<std::string_view> names,
             const std::optional<std::string>& prefix);

  /// Goes to the next message; false at the end.
  /// @throws SetupError  at the end of a file that is empty or not a log.
  bool Next();
  /// The channel name, the prefix before it, and the content of the message.
  std::string_view name() const { return name_; }
  const std::string& prefix() const { return message_prefix_; }
  std::span<const std::uint8_t> bytes() const { return message_.bytes; }
  /// Counts the message as invalid.
  void NoteGarbled() { ++garbled_[message_.channel]; }

  /// Reports damage and invalid messages, one line each.
  std::vector<std::string> Remarks() const;
  /// Returns the requested prefix, or the only one found; empty if none was found.
  /// @throws SetupError  naming them when there are several.
  std::optional<std::string> ChooseAmong(const std::vector<std::string>& found,
                                         const std::string& of_what) const;
  /// Likewise for daemons by their prefixes.
  template <typename Daemon>
  std::optional<std::string> Choose(const std::map<std::string, Daemon>& found,
                                    const std::string& of_what) const {
    std::vector<std::string> prefixes;
    for (const auto& [prefix, daemon] : found) prefixes.push_back(prefix);
    return ChooseAmong(prefixes, of_what);
  }
  /// Lists the prefixes of channels with the first name; empty if there are none.
  std::string PrefixesText() const;

 private:
  bool IsWanted();
  [[noreturn]] void FailAsNoLog() const;

  const std::string log_;
  const std::vector<std::string_view> names_;
  const std::optional<std::string> wanted_prefix_;
  LogReader reader_;
  LoggedMessage message_;
  std::string_view name_;
  std::string message_prefix_;
  bool is_log_ = false;
  std::set<std::string> prefixes_;  ///< Prefixes of the first name.
  std::map<std::string, std::int64_t> garbled_;
};

/// Distinguishes a restarted daemon from several that send on one channel.
class FrameOrder {
 public:
  /// Adds the next frame of a channel. @return  whether it is from a restarted daemon.
  bool Add(std::int64_t frame, std::int64_t timestamp_ns);
  /// Checks that a single daemon sent them: alternating poses of several are no motion.
  /// @throws SetupError  naming the log and the channel.
  void RequireOneDaemon(const std::filesystem::path& log, const std::string& channel) const;

 private:
  std::size_t frames_ = 0, back_ = 0;
  std::int64_t frame_ = 0, timestamp_ns_ = 0;
};

}  // namespace mocap

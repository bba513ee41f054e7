// What logs of LCM messages have in common: channels with prefixes, and what is passed over.
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

/// Reads the messages of some channels out of what lcm-logger recorded.
class ChannelLog {
 public:
  /// @param names   of the channels, without prefix, the one that matters first; none is the end of
  ///                another, and they outlive this.
  /// @param prefix  of the messages that are wanted. Empty: any.
  /// @throws SetupError  when the file cannot be read.
  ChannelLog(const std::filesystem::path& log, std::vector<std::string_view> names,
             const std::optional<std::string>& prefix);

  /// Goes to the next message; false at the end.
  /// @throws SetupError  at the end of a file that is empty or no log.
  bool Next();
  /// Which of the names the message has, what stands before it, and what it says.
  std::string_view name() const { return name_; }
  const std::string& prefix() const { return message_prefix_; }
  std::span<const std::uint8_t> bytes() const { return message_.bytes; }
  /// Counts the message as not understood.
  void NoteGarbled() { ++garbled_[message_.channel]; }

  /// Tells of damage and of messages that were not understood, a line each.
  std::vector<std::string> Remarks() const;
  /// Gives the prefix that was asked for, or the only one that was found; empty where none was.
  /// @throws SetupError  naming them when there are several.
  std::optional<std::string> ChooseAmong(const std::vector<std::string>& found,
                                         const std::string& of_what) const;
  /// The same among daemons by their prefixes.
  template <typename Daemon>
  std::optional<std::string> Choose(const std::map<std::string, Daemon>& found,
                                    const std::string& of_what) const {
    std::vector<std::string> prefixes;
    for (const auto& [prefix, daemon] : found) prefixes.push_back(prefix);
    return ChooseAmong(prefixes, of_what);
  }
  /// Tells with which prefixes there are channels of the first name; empty where there are none.
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
  std::set<std::string> prefixes_;  ///< Before the first name.
  std::map<std::string, std::int64_t> garbled_;
};

/// Tells a daemon that was started again from several that take turns on one channel.
class FrameOrder {
 public:
  /// Takes the next frame of a channel. @return  whether a daemon that was started again sent it.
  bool Add(std::int64_t frame, std::int64_t timestamp_ns);
  /// Makes sure that one daemon sent them: poses of several in turns are nobody's motion.
  /// @throws SetupError  naming the log and the channel.
  void RequireOneDaemon(const std::filesystem::path& log, const std::string& channel) const;

 private:
  std::size_t frames_ = 0, back_ = 0;
  std::int64_t frame_ = 0, timestamp_ns_ = 0;
};

}  // namespace mocap

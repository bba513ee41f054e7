#include "tools/results/people_log.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "core/people/people_capture.h"
#include "daemon/control/control_request.h"
#include "daemon/messages/channel_name.h"
#include "daemon/messages/decode_message.h"
#include "drivers/lowered.h"
#include "drivers/printable_text.h"
#include "tools/results/channel_log.h"
#include "tools/results/pose_log.h"
#include "tools/results/set_details.h"

namespace mocap {
namespace {

/// Data of one person in a log.
struct Person {
  std::string name;
  std::vector<PoseRow> poses;
  std::optional<BodyRecord> body;
};

/// By unique numbers, also across restarts of the daemon.
using People = std::map<std::int64_t, Person>;

std::string NumberName(std::int64_t number) { return "person-" + std::to_string(number); }

/// Chooses names that can be files in one folder: each person's own name, or the number.
std::map<std::int64_t, std::string> NamesOf(const People& people) {
  std::set<std::string> used;
  for (const auto& [number, person] : people) used.insert(NumberName(number));
  std::map<std::int64_t, std::string> names;
  for (const auto& [number, person] : people) {
    // Two people may have had the same name at different times.
    // Some file systems ignore case in names.
    const bool is_own = IsFileName(person.name) && used.insert(Lowered(person.name)).second;
    names[number] = is_own ? person.name : NumberName(number);
  }
  return names;
}

/// Data of one daemon in a log.
class PeopleOfLog {
 public:
  /// Adds a MOCAP_PEOPLE message. @return false if it is invalid.
  bool AddSet(std::span<const std::uint8_t> bytes) {
    const auto set = DecodeMessage<people_t>(bytes);
    const std::optional<std::int64_t> capture_ns =
        set ? CaptureNsOf(set->utime) : std::optional<std::int64_t>();
    if (!capture_ns || set->people.size() > kMostPeople) return false;
    if (order_.Add(set->frame, *capture_ns)) BeginAgain();
    for (const person_t& one : set->people) AddPerson(*set, one);
    return true;
  }
  bool AddBody(std::span<const std::uint8_t> bytes) {
    const auto message = DecodeMessage<person_body_t>(bytes);
    std::optional<BodyRecord> record = message ? BodyRecordOf(message->body) : std::nullopt;
    if (!record || message->id < 1) return false;
    people_[before_ + message->id].body = std::move(record);
    return true;
  }

  bool AddDetails(std::span<const std::uint8_t> bytes) { return details_.Add(bytes); }

  bool HasPeople() const {
    return std::ranges::any_of(people_, [](const auto& one) { return !one.second.poses.empty(); });
  }
  const FrameOrder& order() const { return order_; }
  /// @param remarks  on the log so far.
  PeopleResults Take(const std::filesystem::path& log, std::vector<std::string> remarks) {
    PeopleResults results;
    for (const auto& [number, name] : NamesOf(people_)) {
      Person& person = people_[number];
      if (person.poses.empty()) continue;
      if (!person.body) {
        remarks.push_back(log.string() + ": " + NumberName(number) + " has no body and is skipped");
        continue;
      }
      results.emplace_back(name, Result{*person.body, std::move(person.poses), {}});
      KeepNamedJoints(results.back().second);
    }
    const auto tell = [&](std::int64_t count, const std::string& what) {
      if (count > 0) remarks.push_back(log.string() + ": " + Counted(count, "pose") + what);
    };
    tell(wrong_, " with an invalid number, skipped");
    tell(repeated_, " not later than the one before, skipped");
    if (before_ > 0) {
      remarks.push_back(log.string() +
                        ": mocapd was restarted; people who came since have numbers above " +
                        std::to_string(before_));
    }
    if (!results.empty()) results.front().second.remarks = std::move(remarks);
    return results;
  }

 private:
  /// A restarted daemon counts from 1 again: these are other people.
  void BeginAgain() {
    if (!people_.empty()) before_ = people_.rbegin()->first;
  }
  void AddPerson(const people_t& set, const person_t& one) {
    std::optional<PoseRow> row = PoseRowOf(PoseOf(set, one));
    if (!row || one.id < 1) {
      ++wrong_;
      return;
    }
    ApplyDetails(details_.Of(set.utime, one.id), *row);
    Person& person = people_[before_ + one.id];
    if (!one.name.empty()) person.name = one.name;
    const bool is_later =
        person.poses.empty() || row->timestamp_ns > person.poses.back().timestamp_ns;
    is_later ? person.poses.push_back(*row) : void(++repeated_);
  }

  People people_;
  SetDetails details_;
  FrameOrder order_;
  std::int64_t before_ = 0;  ///< Largest number before the last restart.
  std::int64_t wrong_ = 0, repeated_ = 0;
};

using PeopleByPrefix = std::map<std::string, PeopleOfLog>;

PeopleByPrefix ReadEveryPrefix(ChannelLog& channels) {
  PeopleByPrefix daemons;
  while (channels.Next()) {
    PeopleOfLog& daemon = daemons[channels.prefix()];
    const bool is_ours = channels.name() == kPeopleChannel   ? daemon.AddSet(channels.bytes())
                         : channels.name() == kBodiesChannel ? daemon.AddBody(channels.bytes())
                                                             : daemon.AddDetails(channels.bytes());
    if (!is_ours) channels.NoteGarbled();
  }
  std::erase_if(daemons, [](const auto& one) { return !one.second.HasPeople(); });
  return daemons;
}

}  // namespace

PeopleResults ReadPeopleLog(const std::filesystem::path& log,
                            const std::optional<std::string>& prefix) {
  ChannelLog channels(log, {kPeopleChannel, kBodiesChannel, kDetailsChannel}, prefix);
  PeopleByPrefix daemons = ReadEveryPrefix(channels);
  const std::optional<std::string> name = channels.Choose(daemons, "people");
  const auto chosen = name ? daemons.find(*name) : daemons.end();
  PeopleResults people;
  if (chosen != daemons.end()) {
    chosen->second.order().RequireOneDaemon(log, chosen->first + std::string(kPeopleChannel));
    people = chosen->second.Take(log, channels.Remarks());
  }
  if (people.empty()) {
    throw SetupError(log.string() + ": contains no people on " + Printable(prefix.value_or("")) +
                     std::string(kPeopleChannel) + channels.PrefixesText() +
                     "; expected a log that lcm-logger recorded of mocapd while it tracked people");
  }
  return people;
}

}  // namespace mocap

#include "tools/results/people_log.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/errors.h"
#include "core/people/people_capture.h"
#include "daemon/control/control_request.h"
#include "daemon/messages/decode_message.h"
#include "daemon/messages/log_reader.h"
#include "drivers/printable_text.h"
#include "drivers/quoted.h"
#include "tools/results/pose_log.h"

namespace mocap {
namespace {

constexpr std::string_view kPeople = "MOCAP_PEOPLE", kBodies = "MOCAP_BODIES";

/// What a log has of one person.
struct Person {
  std::string name;
  std::vector<PoseRow> poses;
  std::optional<BodyRecord> body;
};

class PeopleOfLog {
 public:
  /// Takes a message of everybody. @return false for one that is none.
  bool AddSet(std::span<const std::uint8_t> bytes) {
    const auto set = DecodeMessage<people_t>(bytes);
    if (!set || set->people.size() > kMostPeople) return false;
    for (const person_t& one : set->people) {
      const std::optional<PoseRow> row = PoseRowOf(PoseOf(*set, one));
      if (!row) return false;
      Person& person = people_[one.id];
      if (!one.name.empty()) person.name = one.name;
      const bool is_later =
          person.poses.empty() || row->timestamp_ns > person.poses.back().timestamp_ns;
      is_later ? person.poses.push_back(*row) : void(++repeated_);
    }
    return true;
  }
  bool AddBody(std::span<const std::uint8_t> bytes) {
    const auto message = DecodeMessage<person_body_t>(bytes);
    std::optional<BodyRecord> record = message ? BodyRecordOf(message->body) : std::nullopt;
    if (!record) return false;
    people_[message->id].body = std::move(record);
    return true;
  }
  void NoteGarbled() { ++garbled_; }

  bool HasPeople() const {
    return std::ranges::any_of(people_, [](const auto& one) { return !one.second.poses.empty(); });
  }
  PeopleResults Take(const std::filesystem::path& log) {
    PeopleResults results;
    std::vector<std::string> remarks;
    std::set<std::string> names;
    for (auto& [id, person] : people_) {
      const std::string number = "person-" + std::to_string(id);
      if (person.poses.empty()) continue;
      if (!person.body) {
        remarks.push_back(log.string() + ": " + number + " has no body, and is left out");
        continue;
      }
      // Two may have had the same name one after the other; names become files.
      const bool is_own = IsFileName(person.name) && names.insert(person.name).second;
      results.emplace_back(is_own ? person.name : number,
                           Result{*person.body, std::move(person.poses), {}});
    }
    const auto tell = [&](std::int64_t count, const std::string& what) {
      if (count > 0) remarks.push_back(log.string() + ": " + Counted(count, "message") + what);
    };
    tell(garbled_, " not understood by this version, and left out");
    tell(repeated_, " not later than the one before, and left out");
    if (!results.empty()) results.front().second.remarks = std::move(remarks);
    return results;
  }

 private:
  std::map<int, Person> people_;
  std::int64_t garbled_ = 0, repeated_ = 0;
};

using Daemons = std::map<std::string, PeopleOfLog>;

Daemons ReadDaemons(const std::filesystem::path& log) {
  LogReader reader(log);
  Daemons daemons;
  LoggedMessage message;
  while (reader.Next(message)) {
    std::string_view channel = message.channel;
    const bool is_set = channel.ends_with(kPeople);
    if (!is_set && !channel.ends_with(kBodies)) continue;
    channel.remove_suffix(is_set ? kPeople.size() : kBodies.size());
    PeopleOfLog& daemon = daemons[std::string(channel)];
    const bool is_ours = is_set ? daemon.AddSet(message.bytes) : daemon.AddBody(message.bytes);
    if (!is_ours) daemon.NoteGarbled();
  }
  std::erase_if(daemons, [](const auto& one) { return !one.second.HasPeople(); });
  return daemons;
}

}  // namespace

PeopleResults ReadPeopleLog(const std::filesystem::path& log,
                            const std::optional<std::string>& prefix) {
  Daemons daemons = ReadDaemons(log);
  if (!prefix && daemons.size() > 1) {
    std::string found;
    for (const auto& [name, daemon] : daemons) found += (found.empty() ? "" : ", ") + Quoted(name);
    throw SetupError(log.string() + ": holds people of several daemons, with the prefixes " +
                     found + "; --prefix with one of them is wanted");
  }
  const auto chosen = prefix ? daemons.find(*prefix) : daemons.begin();
  PeopleResults people;
  if (chosen != daemons.end()) people = chosen->second.Take(log);
  if (people.empty()) {
    throw SetupError(
        log.string() + ": holds nobody on " + Printable(prefix.value_or("")) +
        std::string(kPeople) +
        "; a log that lcm-logger recorded of mocapd while it followed people is wanted");
  }
  return people;
}

}  // namespace mocap

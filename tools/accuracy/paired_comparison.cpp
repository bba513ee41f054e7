#include "tools/accuracy/paired_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/quantile.h"
#include "drivers/printable_text.h"
#include "drivers/virtual_studio/random.h"

namespace mocap {
namespace {

constexpr int kResamples = 10'000;
constexpr double kOutside = 0.025;  ///< Share of resamples beyond each bound.
constexpr std::size_t kListed = 5;

/// Sums over the runs of a person.
struct PersonSum {
  int errors = 0;  ///< Runs with errors in both versions.
  double before_mm = 0, after_mm = 0;
  int runs = 0;
  double share_before = 0, share_after = 0;

  void Add(const ScoreRow& before, const ScoreRow& after) {
    ++runs;
    share_before += before.tracked_share;
    share_after += after.tracked_share;
    if (!before.errors || !after.errors) return;
    ++errors;
    before_mm += before.errors->mean_mm;
    after_mm += after.errors->mean_mm;
  }
  void Add(const PersonSum& other) {
    errors += other.errors;
    before_mm += other.before_mm;
    after_mm += other.after_mm;
    runs += other.runs;
    share_before += other.share_before;
    share_after += other.share_after;
  }
};

using PeopleSums = std::map<std::string, PersonSum>;

/// Mean differences of as many people, drawn with repetition.
std::vector<double> Resampled(const std::vector<double>& differences_mm) {
  simulation::Random random(simulation::Tag("paired bootstrap"));
  const auto people = static_cast<double>(differences_mm.size());
  std::vector<double> means_mm(kResamples);
  for (double& mean_mm : means_mm) {
    for (std::size_t i = 0; i < differences_mm.size(); ++i)
      mean_mm += differences_mm[static_cast<std::size_t>(random.Uniform(0, people))] / people;
  }
  return means_mm;
}

PairedDifference DifferenceOf(const std::string& label, const PeopleSums& people) {
  PairedDifference result{.label = label};
  std::vector<double> differences_mm;
  for (const auto& [name, sum] : people) {
    result.share_before += sum.share_before / sum.runs / static_cast<double>(people.size());
    result.share_after += sum.share_after / sum.runs / static_cast<double>(people.size());
    if (sum.errors == 0) continue;
    ++result.people;
    result.before_mm += sum.before_mm / sum.errors;
    result.after_mm += sum.after_mm / sum.errors;
    differences_mm.push_back((sum.after_mm - sum.before_mm) / sum.errors);
  }
  if (result.people == 0) return result;
  result.before_mm /= result.people;
  result.after_mm /= result.people;
  std::vector<double> means_mm = Resampled(differences_mm);
  result.low_mm = QuantileOf(means_mm, kOutside);
  result.high_mm = QuantileOf(means_mm, 1 - kOutside);
  return result;
}

std::string ConclusionText(PairedConclusion conclusion) {
  switch (conclusion) {
    case PairedConclusion::kBetter:
      return "better";
    case PairedConclusion::kWorse:
      return "worse";
    case PairedConclusion::kNoDifference:
      return "no difference";
    case PairedConclusion::kTooFew:
      break;
  }
  return "too few people";
}

/// A line that names the first of the rows; nothing without rows.
std::string ListText(const std::vector<ScoreRow>& rows, std::string_view what) {
  if (rows.empty()) return {};
  std::string text = fmt::format("{} {}: ", Counted(rows.size(), "row"), what);
  for (std::size_t i = 0; i < std::min(rows.size(), kListed); ++i)
    text += fmt::format("{}{} {} {} from set {}", i == 0 ? "" : "; ", rows[i].part, rows[i].group,
                        rows[i].person, rows[i].first);
  return text + (rows.size() > kListed ? "; ...\n" : "\n");
}

}  // namespace

PairedConclusion PairedDifference::conclusion() const {
  if (people < kFewestPeople) return PairedConclusion::kTooFew;
  if (high_mm < 0) return PairedConclusion::kBetter;
  return low_mm > 0 ? PairedConclusion::kWorse : PairedConclusion::kNoDifference;
}

PairedComparison ComparePaired(std::span<const ScoreRow> before, std::span<const ScoreRow> after) {
  PairedComparison comparison;
  const auto by_key = [](const ScoreRow& a, const ScoreRow& b) { return a.Key() < b.Key(); };
  std::set<ScoreRow, decltype(by_key)> unpaired(after.begin(), after.end(), by_key);
  std::map<std::string, std::map<std::string, PeopleSums>> groups;  ///< By part and group.
  for (const ScoreRow& row : before) {
    const auto other = unpaired.find(row);
    if (other == unpaired.end()) {
      comparison.only_before.push_back(row);
      continue;
    }
    groups[row.part][row.group][row.person].Add(row, *other);
    if (row.errors && !other->errors) comparison.never_after.push_back(row);
    if (!row.errors && other->errors) comparison.never_before.push_back(row);
    unpaired.erase(other);
  }
  comparison.only_after.assign(unpaired.begin(), unpaired.end());
  for (const auto& [part, part_groups] : groups) {
    PeopleSums all;
    for (const auto& [group, people] : part_groups) {
      comparison.differences.push_back(DifferenceOf(part + ", " + group, people));
      for (const auto& [name, sum] : people) all[name].Add(sum);
    }
    if (part_groups.size() > 1) comparison.differences.push_back(DifferenceOf(part, all));
  }
  return comparison;
}

std::string ComparisonText(const PairedComparison& comparison) {
  std::string text =
      fmt::format("{:<32}{:>7}{:>10}{:>10}{:>12}{:>18}{:>19}  {}\n", "", "people", "before mm",
                  "after mm", "difference", "95 % interval", "tracked %", "conclusion");
  for (const PairedDifference& d : comparison.differences)
    text += fmt::format("{:<32}{:>7}{:>10.2f}{:>10.2f}{:>+12.2f}{:>18}{:>19}  {}\n", d.label,
                        d.people, d.before_mm, d.after_mm, d.difference_mm(),
                        fmt::format("{:+.2f} to {:+.2f}", d.low_mm, d.high_mm),
                        fmt::format("{:.2f} to {:.2f}", 100 * d.share_before, 100 * d.share_after),
                        ConclusionText(d.conclusion()));
  return text + ListText(comparison.only_before, "only before") +
         ListText(comparison.only_after, "only after") +
         ListText(comparison.never_before, "tracked only after") +
         ListText(comparison.never_after, "tracked only before");
}

}  // namespace mocap

#include "tools/report/probability_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mocap {
namespace {

double MeanProbability(const ProbabilityBin& bin) { return bin.sum / bin.frames; }

double RightShare(const ProbabilityBin& bin) {
  return static_cast<double>(bin.right) / static_cast<double>(bin.frames);
}

}  // namespace

void ProbabilityCheck::Add(const ProbabilityCheck& other) {
  for (std::size_t i = 0; i < bins.size(); ++i) {
    bins[i].frames += other.bins[i].frames;
    bins[i].right += other.bins[i].right;
    bins[i].sum += other.bins[i].sum;
  }
}

bool ProbabilityCheck::IsEmpty() const {
  return std::ranges::all_of(bins, [](const ProbabilityBin& bin) { return bin.frames == 0; });
}

ProbabilityCheck CheckProbabilities(const std::vector<PoseRow>& poses, const Accuracy& accuracy) {
  ProbabilityCheck check;
  for (const FrameError& frame : accuracy.frames) {
    const double probability = poses[static_cast<std::size_t>(frame.pose)].probability;
    if (std::isnan(probability)) continue;
    ProbabilityBin* bin = &check.bins.back();
    while (bin != check.bins.data() && probability < bin->least) --bin;
    ++bin->frames;
    bin->right += frame.point_mm.mean() < kRightPoseMm;
    bin->sum += probability;
  }
  return check;
}

std::string ProbabilityTable(const ProbabilityCheck& check) {
  if (check.IsEmpty()) return {};
  std::string text = fmt::format("\n  {:<14}{:>9}{:>9}{:>9}    right: mean error below {:.0f} mm\n",
                                 "probability", "frames", "mean", "right", kRightPoseMm);
  for (const ProbabilityBin& bin : check.bins) {
    text += fmt::format("  {:<14}{:>9}", fmt::format("{} to {}", bin.least, bin.most), bin.frames);
    text += bin.frames > 0
                ? fmt::format("{:>9.3f}{:>7.1f} %\n", MeanProbability(bin), 100 * RightShare(bin))
                : fmt::format("{:>9}{:>9}\n", "-", "-");
  }
  return text;
}

Json ProbabilityJson(const ProbabilityCheck& check) {
  Json json = Json::array();
  for (const ProbabilityBin& bin : check.bins) {
    Json& one = json.emplace_back();
    one["from"] = Rounded(bin.least, 1);
    one["to"] = Rounded(bin.most, 1);
    one["frames"] = bin.frames;
    if (bin.frames == 0) continue;
    one["mean_probability"] = Rounded(MeanProbability(bin), 4);
    one["right_share"] = Rounded(RightShare(bin), 4);
  }
  return json;
}

}  // namespace mocap

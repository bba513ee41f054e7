// What a benchmark measures, and its defaults.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace mocap {

// Defaults of a part.
inline constexpr double kSeconds = 10, kPeopleSeconds = 20, kStudioSeconds = 2, kPaperSeconds = 4,
                        kEvidenceSeconds = 2, kNoiseSeconds = 4;
inline constexpr int kSeeds = 3, kPeopleSeeds = 2, kStudioSeeds = 2, kVariedPeople = 200,
                     kEvidenceSeeds = 1, kNoisePeople = 90, kFirsts = 1, kTakeFirsts = 8;
inline const std::vector<std::string> kMotions = {"walk", "run", "jump",  "dance",  "sit",
                                                  "step", "lie", "stand", "gesture"};
inline const std::vector<std::string> kPeopleMotions = {"walk", "meet", "dance", "visit"};
inline const std::vector<std::string> kSweepMotions = {"walk", "dance", "sit"};
inline const std::vector<std::string> kPaperMotions = {"walk", "run",  "dance",
                                                       "sit",  "step", "jump"};
inline const std::vector<std::string> kEvidenceMotions = {"walk"};
inline const std::vector<double> kStatures_mm = {1150, 1550, 1950},
                                 kPaperStatures_mm = {1300, 1750, 1880},
                                 kEvidenceStatures_mm = {1750};

/// Each takes as long as all others together or longer, so they run only on request.
inline const std::string kPeoplePart = "people", kVarietyPart = "variety", kStudioPart = "studio",
                         kPaperPart = "paper", kEvidencePart = "evidence", kTakesPart = "takes",
                         kNoisePart = "noise", kSolvePart = "solve";

struct BenchmarkOptions {
  std::filesystem::path out;
  double seconds = 0;  ///< 0: the part's default above; also if others are empty or 0.
  std::vector<std::string> motions;
  std::vector<double> statures_mm;
  int seeds = 0;
  int firsts = 0;
  int from = 1;                                ///< Number of the first varied person.
  std::vector<std::string> filmed;             ///< Labels of Filmings; empty: all.
  std::vector<std::filesystem::path> folders;  ///< Of recorded takes.
  std::vector<std::string> parts = {"grid",        "cameras", "voxels", "covered",
                                    "calibration", "mishap",  "tracker"};

  bool Wants(const std::string& part) const {
    return std::ranges::find(parts, part) != parts.end();
  }
  bool IsFilmed(const std::string& label) const {
    return filmed.empty() || std::ranges::find(filmed, label) != filmed.end();
  }
  std::vector<std::string> MotionsOr(const std::vector<std::string>& usual) const {
    return motions.empty() ? usual : motions;
  }
  std::vector<double> StaturesOr(const std::vector<double>& usual) const {
    return statures_mm.empty() ? usual : statures_mm;
  }
  double SecondsOr(double usual) const { return seconds > 0 ? seconds : usual; }
  int SeedsOr(int usual) const { return seeds > 0 ? seeds : usual; }
  int FirstsOr(int usual) const { return firsts > 0 ? firsts : usual; }
};

}  // namespace mocap

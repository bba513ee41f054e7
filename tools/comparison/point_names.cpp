#include "tools/comparison/point_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "core/body/body_part.h"
#include "tools/comparison/result_motion.h"
#include "tools/comparison/text_cells.h"
#include "tools/comparison/text_motion.h"

namespace mocap {
namespace {

/// A point, without its side, and the markers that lie there or around it: alternatives, the
/// likeliest first. Joint centres come first, then keypoints of networks that watch pictures,
/// joints of skeletons, pairs of markers around a joint, and single markers on the skin.
struct Convention {
  std::string_view point, alternatives;
};

/// Of the left side. In names of the right, `L` at the beginning is `R`, and `Left` is `Right`.
constexpr std::array kOfSides = {
    Convention{"clavicle", "LeftShoulder"},
    Convention{"shoulder",
               "LSJC, LShoulder, LeftArm, LeftUpArm, LeftUpperArm, LeftShoulder, LSHO, LACR, "
               "LAcromium, LAcromion, LShoulderStudy"},
    Convention{"elbow",
               "LEJC, LElbow, LeftForeArm, LeftLowArm, LeftElbow, LeftLowerArm, LLEL LMEL, LELB "
               "LELBM, LELB LELBW, LELBL LELBM, LLElbowStudy LMElbowStudy, LELB, LLEL"},
    Convention{"wrist",
               "LWJC, LWrist, LeftHand, LeftWrist, LFAradius LFAulna, LWRA LWRB, LRAD LULN, "
               "LLWristStudy LMWristStudy, LWRA, LWRB"},
    Convention{"hip", "LHJC, LHJCreg, LHip, LeftUpLeg, LeftHip, LeftUpperLeg, LeftThigh"},
    Convention{"knee",
               "LKJC, LKnee, LeftLeg, LeftLowLeg, LeftKnee, LeftLowerLeg, LeftShin, LeftCalf, LLFC "
               "LMFC, LKNE LKNM, LKNE LMKNE, LKNE LKNEM, LKNE LKNEMED, LLKNEE LMKNEE, LKneeLat "
               "LKneeMed, LKneeStudy LMKneeStudy, LKNE, LLFC"},
    Convention{
        "ankle",
        "LAJC, LAnkle, LeftFoot, LeftAnkle, LLMAL LMMAL, LANK LMMA, LANK LMANK, LANK LANKM, "
        "LANK LANKMED, LANK LMED, LLANK LMANK, LAnkleLat LAnkleMed, LAnkleStudy LMAnkleStudy, "
        "LANK, LLMAL"},
    Convention{"fingertips", "LeftHandEnd"},
    Convention{"toe", "LBigToe, LeftToeEnd, LeftToeBaseEnd, LToeTip, LTOE"},
    Convention{"ball", "LeftToe, LeftToeBase, LMT1 LMT5, LMH1 LMH5, LD1M LD5M, LTOE, LMT2, LMH2"},
    Convention{"knuckles", "LeftHandMiddle1, LFIN"},
    Convention{"heel", "LHEE, LHEEL, LCAL, LCALC, LeftHeel, LCalcStudy"}};

constexpr std::array kOfMiddle = {
    Convention{"head", "LFHD RFHD LBHD RBHD"}, Convention{"neck", "C7 CLAV, C7 STRN, C7"},
    Convention{"torso", "Spine2, Spine1, Spine, Chest"},
    Convention{
        kHipsPoint,
        "LASI RASI LPSI RPSI, LASIS RASIS LPSIS RPSIS, LASI RASI SACR, LASI RASI VSACR, LASIS "
        "RASIS VSacral, MidHip, CHip, Hips"}};

std::string Plain(std::string_view name) {
  std::string plain;
  for (const char c : name.substr(name.rfind(':') + 1))
    if (std::isalnum(static_cast<unsigned char>(c)))
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return plain;
}

std::string OfRight(std::string_view left) {
  if (left.starts_with("Left")) return "Right" + std::string(left.substr(4));
  return 'R' + std::string(left.substr(1));
}

/// All pairs of names that conventions have, the likeliest first.
const std::vector<NamedPair>& AllPairs() {
  static const std::vector<NamedPair> pairs = [] {
    std::vector<NamedPair> all;
    const auto add = [&](std::string point, std::string_view alternatives, bool right = false) {
      for (const std::string_view markers : CellsOf(alternatives, ',')) {
        NamedPair& pair = all.emplace_back(NamedPair{point, {}});
        for (const std::string_view word : WordsOf(markers))
          pair.others.push_back(right ? OfRight(word) : std::string(word));
      }
    };
    for (const std::string_view name : kPointNames) add(std::string(name), name);
    for (const std::string_view name : kFurtherPointNames) add(std::string(name), name);
    all.push_back({std::string(kHipsPoint), {std::string(kHipsPoint)}});
    all.push_back({std::string(kPelvisOrigin), {std::string(kPelvisOrigin)}});
    for (const auto& [point, alternatives] : kOfMiddle) add(std::string(point), alternatives);
    for (const auto& [point, alternatives] : kOfSides) {
      add(std::string(point) + "_l", alternatives);
      add(std::string(point) + "_r", alternatives, true);
    }
    return all;
  }();
  return pairs;
}

}  // namespace

std::vector<NamedPair> PairsByName(const RecordedMotion& other) {
  std::map<std::string, std::string> names;
  for (const PointTrack& track : other.points) names.emplace(Plain(track.name), track.name);
  std::vector<NamedPair> found;
  for (const NamedPair& pair : AllPairs()) {
    NamedPair here{pair.point, {}};
    for (const std::string& wanted : pair.others) {
      const auto name = names.find(Plain(wanted));
      if (name != names.end()) here.others.push_back(name->second);
    }
    if (here.others.size() == pair.others.size()) found.push_back(std::move(here));
  }
  return found;
}

std::vector<std::string> PointsNamed(std::string_view name) {
  std::vector<std::string> points;
  for (const NamedPair& pair : AllPairs())
    if (pair.others.size() == 1 && Plain(pair.others[0]) == Plain(name) &&
        std::ranges::find(points, pair.point) == points.end())
      points.push_back(pair.point);
  return points;
}

}  // namespace mocap

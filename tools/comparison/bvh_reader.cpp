#include <algorithm>
#include <span>

#include "core/degrees.h"
#include "drivers/printable_text.h"
#include "tools/comparison/text_cells.h"
#include "tools/comparison/text_motion.h"

namespace mocap {
namespace {

constexpr const char* kBvhWanted = "a skeleton's motion";
constexpr std::size_t kMostBvhNodes = 2000;

struct BvhChannel {
  bool turns = false;
  int axis = 0;
};

struct BvhNode {
  std::string name;
  int parent = -1;
  bool is_end = false;
  Vector3 offset = Vector3::Zero();
  std::vector<BvhChannel> channels;
};

/// Words of the whole file, line by line.
class BvhWords {
 public:
  explicit BvhWords(const std::filesystem::path& file) : lines_(file, kBvhWanted) {}

  /// The next word; empty at the end.
  std::string Next() {
    while (next_ == words_.size()) {
      std::string_view line;
      if (!lines_.Next(line)) return {};
      words_.clear();
      for (const std::string_view word : WordsOf(line)) words_.emplace_back(word);
      next_ = 0;
    }
    return words_[next_++];
  }
  double Number(std::string_view what) { return NeededNumber(Next(), what, lines_); }
  void Need(std::string_view word) {
    const std::string found = Next();
    if (found != word) Fail("has " + Quoted(found) + "; expected " + std::string(word));
  }
  [[noreturn]] void Fail(const std::string& what) const { lines_.Fail(what); }
  /// The rest of the line.
  std::string Rest() {
    std::string rest;
    for (; next_ < words_.size(); ++next_) rest += (rest.empty() ? "" : " ") + words_[next_];
    return rest;
  }
  TextLines& lines() { return lines_; }

 private:
  TextLines lines_;
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

BvhChannel ChannelOf(const std::string& name, const BvhWords& words) {
  const std::size_t axis = name.empty() ? 3 : std::string_view("XYZ").find(name[0]);
  const std::string kind = name.empty() ? "" : name.substr(1);
  if (axis > 2 || (kind != "rotation" && kind != "position"))
    words.Fail("has the channel " + Quoted(name) +
               "; expected Xposition or Zrotation, or the like");
  return {kind == "rotation", static_cast<int>(axis)};
}

void ReadChannels(BvhWords& words, BvhNode& node) {
  const double count = words.Number("the count of channels");
  if (!(count >= 0 && count <= 12)) words.Fail("has too many channels; expected at most 12");
  for (int i = 0; i < count; ++i) node.channels.push_back(ChannelOf(words.Next(), words));
}

/// Reads the tree without recursion: its depth is the file's choice.
std::vector<BvhNode> ReadHierarchy(BvhWords& words) {
  std::vector<BvhNode> nodes;
  std::vector<int> open;
  for (;;) {
    const std::string word = words.Next();
    if (word.empty()) words.Fail("ends in its hierarchy");
    if (word == "ROOT" || word == "JOINT" || word == "End") {
      if (nodes.size() >= kMostBvhNodes) words.Fail("has more than 2000 joints");
      BvhNode node;
      node.parent = open.empty() ? -1 : open.back();
      node.is_end = word == "End";
      const std::string name = words.Rest();
      node.name = node.is_end && node.parent >= 0
                      ? nodes[static_cast<std::size_t>(node.parent)].name + "End"
                      : name.substr(name.rfind(':') + 1);
      words.Need("{");
      open.push_back(static_cast<int>(nodes.size()));
      nodes.push_back(std::move(node));
    } else if (word == "OFFSET" && !open.empty()) {
      for (double& value : nodes[static_cast<std::size_t>(open.back())].offset)
        value = words.Number("an offset");
    } else if (word == "CHANNELS" && !open.empty()) {
      ReadChannels(words, nodes[static_cast<std::size_t>(open.back())]);
    } else if (word == "}" && !open.empty()) {
      open.pop_back();
    } else if (word == "MOTION" && open.empty() && !nodes.empty()) {
      return nodes;
    } else {
      words.Fail("has " + Quoted(word) + " in its hierarchy; expected joints");
    }
  }
}

Matrix3 TurnAbout(int axis, double deg) {
  return Eigen::AngleAxisd(deg / kDegreesPerRad, Vector3::Unit(axis)).toRotationMatrix();
}

/// Adds a frame's joints by its channels' values.
class BvhPoser {
 public:
  explicit BvhPoser(std::vector<BvhNode> nodes) : nodes_(std::move(nodes)), X_(nodes_.size()) {}

  const std::vector<BvhNode>& nodes() const { return nodes_; }

  void Add(std::span<const double> values, RecordedMotion& motion) {
    std::size_t next = 0, joint = 0;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const BvhNode& node = nodes_[i];
      RigidTransform X{Matrix3::Identity(), node.offset};
      Vector3 place = Vector3::Zero();
      bool moves = false;
      for (const BvhChannel& channel : node.channels) {
        const double value = values[next++];
        if (channel.turns) X.R = X.R * TurnAbout(channel.axis, value);
        if (!channel.turns) place[channel.axis] = value;
        moves = moves || !channel.turns;
      }
      // Positions take the place of the offset, as Blender and MotionBuilder read them.
      if (moves) X.p = place;
      X_[i] = node.parent < 0 ? X : X_[static_cast<std::size_t>(node.parent)] * X;
      motion.points[i].p_mm.push_back(X_[i].p);
      if (!node.is_end) motion.joints[joint++].R.push_back(X.R);
    }
  }

 private:
  std::vector<BvhNode> nodes_;
  std::vector<RigidTransform> X_;
};

RecordedMotion EmptyMotion(const std::vector<BvhNode>& nodes) {
  RecordedMotion motion;
  motion.has_unit = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    motion.points.push_back({nodes[i].name, {}});
    if (nodes[i].is_end) continue;
    const auto child = std::ranges::find(nodes, static_cast<int>(i), &BvhNode::parent);
    motion.joints.push_back(
        {nodes[i].name, child == nodes.end() ? Vector3(Vector3::Zero()) : child->offset, {}});
  }
  return motion;
}

}  // namespace

MotionFile ReadBvh(const std::filesystem::path& file) {
  BvhWords words(file);
  words.Need("HIERARCHY");
  BvhPoser poser(ReadHierarchy(words));
  words.Need("Frames:");
  words.Number("the count of frames");
  words.Need("Frame");
  words.Need("Time:");
  const double period_s = words.Number("the frame time");
  if (!(period_s > 1e-6 && period_s < 1e3)) words.Fail("has no valid frame time");
  std::size_t channels = 0;
  for (const BvhNode& node : poser.nodes()) channels += node.channels.size();
  RecordedMotion motion = EmptyMotion(poser.nodes());
  std::vector<double> values;
  std::string_view line;
  while (words.lines().Next(line)) {
    const auto cells = WordsOf(line);
    if (cells.empty()) continue;
    if (cells.size() != channels) {
      words.Fail("has " + Counted(cells.size(), "number") + "; expected " +
                 std::to_string(channels) + ", one per channel");
    }
    values.clear();
    for (const std::string_view cell : cells)
      values.push_back(NeededNumber(cell, "a channel", words.lines()));
    motion.time_s.push_back(period_s * static_cast<double>(motion.time_s.size()));
    poser.Add(values, motion);
  }
  if (motion.time_s.empty()) words.Fail("has no frame; expected at least one");
  return {"BVH", {std::move(motion)}, {}};
}

}  // namespace mocap

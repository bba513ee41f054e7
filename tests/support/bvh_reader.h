// A reader of BVH that knows nothing of the writer: what an animation program would do.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace mocap::testing {

inline constexpr double kBvhDegree = std::numbers::pi / 180;

struct ReadNode {
  std::string name;
  int parent;
  Eigen::Vector3d offset;
  std::vector<std::string> channels;
};

struct ReadBvh {
  std::vector<ReadNode> nodes;
  std::vector<std::vector<double>> frames;
  double frame_time = 0;
};

inline ReadBvh ParseBvh(const std::string& text) {
  std::istringstream in(text);
  ReadBvh bvh;
  std::vector<int> open;
  std::string word, name;
  while (in >> word && word != "MOTION") {
    if (word == "ROOT" || word == "JOINT") in >> name;
    if (word == "End") {
      in >> word;
      name = bvh.nodes.back().name + "_end";
    }
    if (word == "{") {
      bvh.nodes.push_back({name, open.empty() ? -1 : open.back(), {}, {}});
      open.push_back(static_cast<int>(bvh.nodes.size()) - 1);
    }
    if (word == "}") open.pop_back();
    if (word == "OFFSET") {
      for (double& value : bvh.nodes.back().offset) in >> value;
    }
    if (word == "CHANNELS") {
      int count = 0;
      in >> count;
      for (; count > 0; --count) in >> bvh.nodes.back().channels.emplace_back();
    }
  }
  std::size_t frame_count = 0, width = 0;
  in >> word >> frame_count >> word >> word >> bvh.frame_time;
  for (const ReadNode& node : bvh.nodes) width += node.channels.size();
  bvh.frames.assign(frame_count, std::vector<double>(width));
  for (std::vector<double>& frame : bvh.frames) {
    for (double& value : frame) EXPECT_TRUE(in >> value);
  }
  EXPECT_FALSE(in >> word) << "more numbers than channels";
  return bvh;
}

/// Axes and places of all joints and end sites [cm].
inline std::map<std::string, Eigen::Isometry3d> JointsAt(const ReadBvh& bvh, std::size_t frame) {
  std::vector<Eigen::Isometry3d> world;
  std::map<std::string, Eigen::Isometry3d> joints;
  auto value = bvh.frames[frame].begin();
  for (const ReadNode& node : bvh.nodes) {
    Eigen::Isometry3d X = node.parent < 0 ? Eigen::Isometry3d::Identity() : world[node.parent];
    X.translate(node.offset);
    for (const std::string& channel : node.channels) {
      const Eigen::Vector3d axis(channel[0] == 'X', channel[0] == 'Y', channel[0] == 'Z');
      if (channel.ends_with("position")) X.translate(*value * axis);
      if (channel.ends_with("rotation")) X.rotate(Eigen::AngleAxisd(*value * kBvhDegree, axis));
      ++value;
    }
    world.push_back(X);
    joints[node.name] = X;
  }
  return joints;
}

/// Places of all joints and end sites [cm].
inline std::map<std::string, Eigen::Vector3d> PlacesAt(const ReadBvh& bvh, std::size_t frame) {
  std::map<std::string, Eigen::Vector3d> places;
  for (const auto& [name, X] : JointsAt(bvh, frame)) places[name] = X.translation();
  return places;
}

}  // namespace mocap::testing

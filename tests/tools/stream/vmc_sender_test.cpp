// What is sent, as a reader that shares nothing with the sender has it: oscpack.
#include "tools/stream/vmc_sender.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <oscpack/osc/OscReceivedElements.h>
#include <sys/socket.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "daemon/base/file_descriptor.h"
#include "tests/support/posed_people.h"
#include "tests/support/setup_error.h"

namespace mocap {
namespace {

using ::testing::HasSubstr;
using testing::RandomPose;
using testing::SetupErrorOf;

constexpr std::size_t kEthernetPayload = 1472;

/// A transform as it stands in a message: metres in Unity's axes.
struct Sent {
  Vector3 p;
  Eigen::Quaterniond q;
};

/// What Unity makes of it: each object's place in the world from its parents'. Its multiplication
/// of quaternions is the usual one.
struct Placed {
  Vector3 p;
  Eigen::Quaterniond q;
  Placed operator*(const Sent& child) const { return {p + q * child.p, q * child.q}; }
};

struct Heard {
  std::vector<int> status;
  std::vector<float> times_s;
  std::map<std::string, Sent> bones;
  int roots = 0, packets = 0;
};

/// A receiver's socket.
class Receiver {
 public:
  Receiver() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    port_ = Bind(place, place.sin_port);
  }
  /// Of IPv6.
  explicit Receiver(const in6_addr& host) : fd_(socket(AF_INET6, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in6 place{};
    place.sin6_family = AF_INET6;
    place.sin6_addr = host;
    port_ = Bind(place, place.sin6_port);
  }
  bool is_open() const { return port_ > 0; }
  std::string port() const { return std::to_string(port_); }
  std::string place() const { return "127.0.0.1:" + port(); }

  /// Reads what has come: on this host it is here when sending returns.
  Heard TakeAll() {
    Heard heard;
    std::array<char, 65536> bytes;
    for (;;) {
      const ssize_t size = recv(fd_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
      if (size < 0) return heard;
      EXPECT_LE(size, static_cast<ssize_t>(kEthernetPayload));
      ++heard.packets;
      const osc::ReceivedPacket packet(bytes.data(), static_cast<std::size_t>(size));
      EXPECT_TRUE(packet.IsBundle());
      const osc::ReceivedBundle bundle(packet);
      for (auto element = bundle.ElementsBegin(); element != bundle.ElementsEnd(); ++element) {
        Read(osc::ReceivedMessage(*element), heard);
      }
    }
  }

 private:
  static void Read(const osc::ReceivedMessage& message, Heard& heard) {
    const std::string address = message.AddressPattern();
    auto argument = message.ArgumentsBegin();
    if (address == "/VMC/Ext/OK") {
      heard.status.clear();
      while (argument != message.ArgumentsEnd()) heard.status.push_back((argument++)->AsInt32());
    } else if (address == "/VMC/Ext/T") {
      heard.times_s.push_back(argument->AsFloat());
    } else {
      const std::string name = (argument++)->AsString();
      std::array<double, 7> numbers{};
      for (double& number : numbers) number = static_cast<double>((argument++)->AsFloat());
      EXPECT_EQ(argument, message.ArgumentsEnd());
      const auto& [px, py, pz, qx, qy, qz, qw] = numbers;
      const Sent sent{{px, py, pz}, {qw, qx, qy, qz}};
      EXPECT_NEAR(sent.q.norm(), 1, 1e-5);
      if (address == "/VMC/Ext/Root/Pos") {
        EXPECT_EQ(name, "root");
        EXPECT_TRUE(sent.p.isZero());
        EXPECT_EQ(sent.q.w(), 1);
        ++heard.roots;
      } else {
        EXPECT_EQ(address, "/VMC/Ext/Bone/Pos");
        EXPECT_TRUE(heard.bones.emplace(name, sent).second) << name;
      }
    }
  }

  /// @return  the port; 0: there is no such address here.
  template <typename Place>
  int Bind(Place& place, const in_port_t& port) const {
    socklen_t size = sizeof place;
    if (bind(fd_.get(), reinterpret_cast<sockaddr*>(&place), size) != 0) return 0;
    EXPECT_EQ(getsockname(fd_.get(), reinterpret_cast<sockaddr*>(&place), &size), 0);
    return ntohs(port);
  }

  FileDescriptor fd_;
  int port_ = 0;
};

/// The bones of Unity's humanoid, from each to its parent there.
const std::map<std::string, std::string> kParents = {{"Hips", ""},
                                                     {"Spine", "Hips"},
                                                     {"Chest", "Spine"},
                                                     {"Neck", "Chest"},
                                                     {"Head", "Neck"},
                                                     {"LeftShoulder", "Chest"},
                                                     {"LeftUpperArm", "LeftShoulder"},
                                                     {"LeftLowerArm", "LeftUpperArm"},
                                                     {"LeftHand", "LeftLowerArm"},
                                                     {"RightShoulder", "Chest"},
                                                     {"RightUpperArm", "RightShoulder"},
                                                     {"RightLowerArm", "RightUpperArm"},
                                                     {"RightHand", "RightLowerArm"},
                                                     {"LeftUpperLeg", "Hips"},
                                                     {"LeftLowerLeg", "LeftUpperLeg"},
                                                     {"LeftFoot", "LeftLowerLeg"},
                                                     {"LeftToes", "LeftFoot"},
                                                     {"RightUpperLeg", "Hips"},
                                                     {"RightLowerLeg", "RightUpperLeg"},
                                                     {"RightFoot", "RightLowerLeg"},
                                                     {"RightToes", "RightFoot"}};

Placed PlaceOf(const std::string& bone, const Heard& heard) {
  const std::string& parent = kParents.at(bone);
  const Placed root{Vector3::Zero(), Eigen::Quaterniond::Identity()};
  return (parent.empty() ? root : PlaceOf(parent, heard)) * heard.bones.at(bone);
}

/// In the studio's millimetres: Unity has x to the right, y up and z forward.
Vector3 InStudio(const Vector3& p_m) { return 1000 * Vector3(p_m.z(), -p_m.x(), p_m.y()); }

const std::map<std::string, Point> kPoints = {{"Spine", Point::kTorso},
                                              {"Neck", Point::kNeck},
                                              {"LeftUpperArm", Point::kShoulderL},
                                              {"RightUpperArm", Point::kShoulderR},
                                              {"LeftLowerArm", Point::kElbowL},
                                              {"RightLowerArm", Point::kElbowR},
                                              {"LeftUpperLeg", Point::kHipL},
                                              {"RightUpperLeg", Point::kHipR},
                                              {"LeftLowerLeg", Point::kKneeL},
                                              {"RightLowerLeg", Point::kKneeR}};

class VmcSenderTest : public ::testing::TestWithParam<const char*> {
 protected:
  Heard Send(const PoseState& pose) {
    receiver_.TakeAll();
    sender_.SendPose(HumanoidPoseOf(body_, pose), 2.5);
    EXPECT_EQ(sender_.trouble(), "");
    return receiver_.TakeAll();
  }

  const BodyModel body_{LoadBodyTable(GetParam()), AverageSizes(1700)};
  Receiver receiver_;
  VmcSender sender_{receiver_.place()};
};

TEST_P(VmcSenderTest, AllBonesOfAHumanoidAreSentOnce) {
  const Heard heard = Send(RandomPose(body_, 1));
  EXPECT_EQ(heard.bones.size(), kParents.size());
  for (const auto& [bone, parent] : kParents) EXPECT_TRUE(heard.bones.contains(bone)) << bone;
  EXPECT_EQ(heard.roots, 1);
  EXPECT_GT(heard.packets, 1);
  EXPECT_THAT(heard.times_s, ::testing::ElementsAre(2.5f));
}

TEST_P(VmcSenderTest, TurnsAndPlacesTogetherGiveTheJointsBack) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PoseState pose = RandomPose(body_, seed);
    const BodyPoints points_W = body_.PointsAt(body_.PostureAt(pose));
    const Heard heard = Send(pose);
    for (const auto& [bone, point] : kPoints) {
      const Vector3 p_WQ = points_W.col(static_cast<int>(point));
      EXPECT_LT((InStudio(PlaceOf(bone, heard).p) - p_WQ).norm(), 0.1) << bone << ' ' << seed;
    }
  }
}

TEST_P(VmcSenderTest, HandsHeadAndFeetPointWhereTheirPointsLie) {
  const PoseState pose = RandomPose(body_, 4);
  const BodyPoints points_W = body_.PointsAt(body_.PostureAt(pose));
  const Heard heard = Send(pose);
  // In a T-pose, Unity's left hand lies along -x, the right one along x, the head up.
  const std::map<std::string, std::pair<Vector3, Point>> ends = {
      {"LeftHand", {-Vector3::UnitX(), Point::kFingertipsL}},
      {"RightHand", {Vector3::UnitX(), Point::kFingertipsR}}};
  for (const auto& [bone, end] : ends) {
    const Placed hand = PlaceOf(bone, heard);
    const Vector3 wrist = InStudio(hand.p);
    const Vector3 tip = points_W.col(static_cast<int>(end.second));
    const Vector3 direction = InStudio(hand.q * end.first).normalized();
    EXPECT_GT(direction.dot((tip - wrist).normalized()), 0.99999) << bone;
  }
  // The ankle lies on the way from the knee to the sole.
  for (const auto& [bone, knee, foot] : {std::tuple("LeftFoot", Point::kKneeL, Point::kFootL),
                                         std::tuple("RightFoot", Point::kKneeR, Point::kFootR)}) {
    const Vector3 p_WK = points_W.col(static_cast<int>(knee)),
                  p_WF = points_W.col(static_cast<int>(foot));
    const Vector3 ankle = InStudio(PlaceOf(bone, heard).p);
    EXPECT_NEAR((ankle - p_WK).norm() + (p_WF - ankle).norm(), (p_WF - p_WK).norm(), 0.1) << bone;
  }
}

TEST_P(VmcSenderTest, ToesLieAtTheBallsOfTheFeetAndTurnWithThem) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const PoseState pose = RandomPose(body_, seed);
    const Posture posture = body_.PostureAt(pose);
    const Heard heard = Send(pose);
    for (const auto& [bone, ball, toe] : {std::tuple("LeftToes", Point::kBallL, Point::kToeL),
                                          std::tuple("RightToes", Point::kBallR, Point::kToeR)}) {
      const auto at = [&](Point point) { return body_.PlaceOf(point, posture); };
      const Placed toes = PlaceOf(bone, heard);
      EXPECT_LT((InStudio(toes.p) - at(ball)).norm(), 0.1) << bone;
      const Vector3 forward = InStudio(toes.q * Vector3::UnitZ()).normalized();
      EXPECT_GT(forward.dot((at(toe) - at(ball)).normalized()), 0.99999) << bone;
    }
  }
}

TEST_P(VmcSenderTest, WhoFacesForwardInATPoseIsNotTurnedAndHasHisLeftOnTheLeft) {
  PoseState pose;
  pose.theta = JointAngles::Zero(body_.joint_count());
  pose.X_WT.p = Vector3(2000, 500, 1000);
  const Heard heard = Send(pose);
  for (const auto& [bone, sent] : heard.bones) EXPECT_NEAR(std::abs(sent.q.w()), 1, 1e-6) << bone;
  // Forward is z, to the left is -x, up is y.
  EXPECT_NEAR(PlaceOf("Spine", heard).p.z(), 2.0, 1e-5);
  EXPECT_NEAR(PlaceOf("Spine", heard).p.x(), -0.5, 1e-5);
  EXPECT_LT(PlaceOf("LeftHand", heard).p.x(), PlaceOf("RightHand", heard).p.x() - 0.5);
  EXPECT_GT(PlaceOf("Head", heard).p.y(), PlaceOf("LeftFoot", heard).p.y() + 1);
}

TEST_P(VmcSenderTest, ABentElbowBringsTheHandForward) {
  PoseState pose;
  pose.theta = JointAngles::Zero(body_.joint_count());
  for (int i = 0; i < body_.joint_count(); ++i) {
    if (body_.table().joints[static_cast<std::size_t>(i)].name == "elbow_l_z") pose.theta[i] = -1.5;
  }
  const Heard heard = Send(pose);
  EXPECT_GT(PlaceOf("LeftHand", heard).p.z(), PlaceOf("LeftLowerArm", heard).p.z() + 0.15);
  EXPECT_NEAR(PlaceOf("RightHand", heard).p.z(), PlaceOf("RightLowerArm", heard).p.z(), 1e-5);
}

TEST_P(VmcSenderTest, WhoIsNotTrackedHasNoBonesAndAStatusThatTells) {
  const std::map<CaptureState, std::vector<int>> wanted = {{CaptureState::kSearching, {0, 0, 0, 0}},
                                                           {CaptureState::kAcquiring, {0, 2, 0, 0}},
                                                           {CaptureState::kLost, {1, 3, 0, 0}}};
  for (const auto& [state, status] : wanted) {
    receiver_.TakeAll();
    sender_.SendState(state, 1);
    const Heard heard = receiver_.TakeAll();
    EXPECT_EQ(heard.status, status);
    EXPECT_TRUE(heard.bones.empty());
  }
  EXPECT_EQ(Send(RandomPose(body_, 1)).status, (std::vector<int>{1, 3, 0, 1}));
}

INSTANTIATE_TEST_SUITE_P(Bodies, VmcSenderTest, ::testing::Values("full", "mikic2003"),
                         [](const auto& body) { return std::string(body.param); });

TEST(VmcSender, SaysHelloOfNobody) {
  Receiver receiver;
  const VmcSender sender(receiver.place());
  EXPECT_EQ(receiver.TakeAll().status, (std::vector<int>{0, 0, 0, 0}));
}

TEST(VmcSender, ReachesTheAddressOfIPv6ThatItsMessageOffers) {
  Receiver receiver(in6addr_loopback);
  if (!receiver.is_open()) GTEST_SKIP() << "there is no IPv6";
  const VmcSender sender("[::1]:" + receiver.port());
  EXPECT_EQ(receiver.TakeAll().status, (std::vector<int>{0, 0, 0, 0}));
}

TEST(VmcSender, ANameThatIsBothIsReachedByIPv4) {
  Receiver receiver;
  const VmcSender sender("localhost:" + receiver.port());
  EXPECT_EQ(receiver.TakeAll().status, (std::vector<int>{0, 0, 0, 0}));
}

TEST(VmcSender, AnAddressThatIsNoneIsTold) {
  for (const char* wrong : {"", "localhost", ":39539", "localhost:", "localhost:0",
                            "localhost:65536", "localhost:39539x", "::1:39539", "[::1]"}) {
    EXPECT_THAT(SetupErrorOf([&] { VmcSender sender(wrong); }), HasSubstr("expected HOST:PORT"))
        << wrong;
  }
}

TEST(VmcSender, AHostThatNobodyKnowsIsTold) {
  EXPECT_THAT(SetupErrorOf([] { VmcSender sender("nobody.invalid:39539"); }),
              HasSubstr("--to: nobody.invalid:39539: "));
}

}  // namespace
}  // namespace mocap

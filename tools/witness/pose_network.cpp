#include "tools/witness/pose_network.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/errors.h"
#include "drivers/nearest_name.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"

namespace mocap {
namespace {

constexpr int kBlazePoseInput_px = 256;
constexpr std::size_t kBlazePoseNumbers = 195;  // 39 points of 5 numbers.
constexpr std::array<std::pair<int, int>, 2> kRtmPoseInputs_px = {{{192, 256}, {288, 384}}};
constexpr int kSimccBinsPerPixel = 2;

struct NamedOutput {
  std::string name;
  cv::Mat numbers;
};
using NamedOutputs = std::vector<NamedOutput>;

std::string ShapeOf(const cv::Mat& numbers) {
  std::string shape;
  for (int i = 0; i < numbers.dims; ++i)
    shape += (i == 0 ? "" : " x ") + std::to_string(numbers.size[i]);
  return shape;
}

std::span<const float> FloatsOf(const cv::Mat& numbers) {
  return {numbers.ptr<float>(), numbers.total()};
}

const cv::Mat* FindOutput(const NamedOutputs& outputs, const std::string& name) {
  const auto found = std::ranges::find(outputs, name, &NamedOutput::name);
  return found == outputs.end() ? nullptr : &found->numbers;
}

/// OpenCV's reason without its place in OpenCV.
std::string ReasonOf(const cv::Exception& error) {
  std::string reason = error.err.empty() ? error.what() : error.err;
  std::ranges::replace(reason, '\n', ' ');
  return reason;
}

/// The crop of a picture as the network takes it.
cv::Mat BlobOf(const NetworkDescription& network, const cv::Mat& crop) {
  cv::Mat blob({1, 3, network.height_px, network.width_px}, CV_32F);
  const std::size_t plane = static_cast<std::size_t>(network.width_px) * network.height_px;
  auto* const out = blob.ptr<float>();
  const auto* const in = crop.ptr<cv::Vec3b>();
  for (int color = 0; color < 3; ++color) {
    const int channel = network.takes_rgb ? 2 - color : color;
    for (std::size_t i = 0; i < plane; ++i)
      out[color * plane + i] =
          static_cast<float>((in[i][channel] - network.mean[color]) / network.std[color]);
  }
  return blob;
}

}  // namespace

class PoseNetwork::Impl {
 public:
  explicit Impl(const std::filesystem::path& model) : file_(model) {
    // What OpenCV finds wrong is said in one line of ours.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
    cv::setNumThreads(1);
    RequireFile(model, "an ONNX file");
    Load();
    const std::filesystem::path beside = DescriptionBeside(model);
    if (IsThere(beside)) {
      network_ = ReadNetworkDescription(beside);
      RequireOutputs(Compute(network_.width_px, network_.height_px));
    } else {
      network_ = Recognized();
    }
  }

  const NetworkDescription& description() const { return network_; }

  std::vector<Keypoint> Find(ImageView<const Bgr> picture, const PictureRegion& region) {
    const CropMap map = MapOf(region, network_.width_px, network_.height_px);
    const auto& M = map.turn_and_scale;
    const cv::Matx23d to_picture(M(0, 0), M(0, 1), map.origin_px.x(), M(1, 0), M(1, 1),
                                 map.origin_px.y());
    // OpenCV does not change it.
    const cv::Mat whole(picture.height(), picture.width(), CV_8UC3,
                        const_cast<Bgr*>(picture.row(0)), picture.stride() * sizeof(Bgr));
    cv::warpAffine(whole, crop_, to_picture, {network_.width_px, network_.height_px},
                   cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT);
    const NamedOutputs outputs = Forward(BlobOf(network_, crop_));
    const bool are_finite = std::ranges::all_of(
        outputs, [](const NamedOutput& output) { return cv::checkRange(output.numbers); });
    return are_finite ? KeypointsOf(outputs, map) : std::vector<Keypoint>();
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw SetupError(file_.string() + ": " + what);
  }

  void Load() {
    try {
      net_ = cv::dnn::readNetFromONNX(file_.string());
      net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      names_ = net_.getUnconnectedOutLayersNames();
    } catch (const cv::Exception& error) {
      Fail("OpenCV cannot read it: " + ReasonOf(error) + "; expected a network as ONNX");
    }
  }

  NamedOutputs Forward(const cv::Mat& blob) {
    std::vector<cv::Mat> numbers;
    net_.setInput(blob);
    net_.forward(numbers, names_);
    NamedOutputs outputs;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (numbers[i].type() != CV_32F)
        Fail("its output " + names_[i] + " has no floating-point numbers");
      outputs.push_back({names_[i], numbers[i]});
    }
    return outputs;
  }

  /// Computes for a black input of this size.
  NamedOutputs Compute(int width_px, int height_px) {
    try {
      return Forward(cv::Mat({1, 3, height_px, width_px}, CV_32F, cv::Scalar(0)));
    } catch (const cv::Exception& error) {
      Fail("OpenCV cannot compute it for an input of 1 x 3 x " + std::to_string(height_px) + " x " +
           std::to_string(width_px) + ": " + ReasonOf(error));
    }
  }

  NetworkDescription Recognized() {
    if (const auto network = Attempt([this] { return AsRtmPose(); })) return *network;
    if (const auto network = Attempt([this] { return AsBlazePose(); })) return *network;
    Fail(
        "is neither BlazePose, with 195 numbers for an input of 256 x 256, nor RTMPose, with "
        "outputs simcc_x and simcc_y; expected a description of its input and outputs in " +
        DescriptionBeside(file_).string());
  }

  /// A network that cannot be computed for an input is another one.
  static std::optional<NetworkDescription> Attempt(
      const std::function<std::optional<NetworkDescription>()>& recognize) {
    try {
      return recognize();
    } catch (const SetupError&) {
      return std::nullopt;
    }
  }

  std::optional<NetworkDescription> AsBlazePose() {
    std::string presence, points;
    for (const auto& [name, numbers] : Compute(kBlazePoseInput_px, kBlazePoseInput_px)) {
      if (numbers.total() == kBlazePoseNumbers) points = name;
      if (numbers.total() == 1) presence = name;
    }
    if (points.empty()) return std::nullopt;
    return BlazePoseDescription(points, presence);
  }

  std::optional<NetworkDescription> AsRtmPose() {
    if (std::ranges::find(names_, "simcc_x") == names_.end()) return std::nullopt;
    for (const auto& [width_px, height_px] : kRtmPoseInputs_px) {
      const auto network =
          Attempt([&, width = width_px, height = height_px] { return AsRtmPose(width, height); });
      if (network) return network;
    }
    return std::nullopt;
  }

  std::optional<NetworkDescription> AsRtmPose(int width_px, int height_px) {
    const NamedOutputs outputs = Compute(width_px, height_px);
    const cv::Mat* const x = FindOutput(outputs, "simcc_x");
    const cv::Mat* const y = FindOutput(outputs, "simcc_y");
    if (!x || !y || x->dims != 3 || y->dims != 3 || x->size[1] != y->size[1]) return std::nullopt;
    const int points = x->size[1];
    const bool is_known = points == 17 || points == 26 || points == 133;
    if (!is_known || x->size[2] != kSimccBinsPerPixel * width_px ||
        y->size[2] != kSimccBinsPerPixel * height_px)
      return std::nullopt;
    return RtmPoseDescription(points, width_px, height_px);
  }

  /// Checks that outputs are as described.
  void RequireOutputs(const NamedOutputs& outputs) const {
    std::vector<std::string> wanted = network_.outputs;
    if (!network_.presence.empty()) wanted.push_back(network_.presence);
    for (const std::string& name : wanted)
      if (!FindOutput(outputs, name))
        Fail("has no output " + Quoted(name) + "; " + ExpectedNames(name, names_));
    for (const std::string& name : network_.outputs) RequireShape(name, *FindOutput(outputs, name));
    if (network_.presence.empty()) return;
    const cv::Mat& presence = *FindOutput(outputs, network_.presence);
    if (presence.total() != 1)
      Fail("its output " + network_.presence + " is " + ShapeOf(presence) +
           "; expected one number");
  }

  void RequireShape(const std::string& name, const cv::Mat& numbers) const {
    const auto points = static_cast<int>(network_.landmarks.size());
    const std::string points_text = std::to_string(points);
    bool fits = false;
    std::string wanted;
    if (network_.kind == AnswerKind::kHeatmaps) {
      fits = numbers.dims == 4 && numbers.size[1] == points && numbers.size[2] > 1 &&
             numbers.size[3] > 1;
      wanted = "1 x " + points_text + " x height x width";
    } else if (network_.kind == AnswerKind::kSimcc) {
      fits = numbers.dims == 3 && numbers.size[1] == points && numbers.size[2] > 1;
      wanted = "1 x " + points_text + " x bins";
    } else {
      fits = numbers.total() == points * network_.columns.size();
      wanted = points_text + " x " + std::to_string(network_.columns.size()) + " numbers";
    }
    if (!fits)
      Fail("its output " + name + " is " + ShapeOf(numbers) + "; expected " + wanted + ", for " +
           points_text + " landmarks");
  }

  std::vector<FoundPoint> Decode(const NamedOutputs& outputs) const {
    const cv::Mat& numbers = *FindOutput(outputs, network_.outputs.front());
    const std::span<const float> values = FloatsOf(numbers);
    if (network_.kind == AnswerKind::kHeatmaps)
      return DecodeHeatmaps(values, numbers.size[2], numbers.size[3], network_.width_px,
                            network_.height_px);
    if (network_.kind == AnswerKind::kSimcc)
      return DecodeSimcc(values, FloatsOf(*FindOutput(outputs, network_.outputs.back())),
                         static_cast<int>(network_.landmarks.size()), network_.width_px,
                         network_.height_px);
    return DecodeCoordinates(values, network_.columns, network_.scores_are_logits);
  }

  /// A point that is farther outside than the crop is large is no answer.
  bool IsNearCrop(const Vector2& crop_px) const {
    const Vector2 share = crop_px.cwiseQuotient(Vector2(network_.width_px, network_.height_px));
    return (share.array() > -1).all() && (share.array() < 2).all();
  }

  std::vector<Keypoint> KeypointsOf(const NamedOutputs& outputs, const CropMap& map) const {
    const bool are_probabilities =
        !network_.scores_are_logits || network_.kind == AnswerKind::kCoordinates;
    double presence = 1;
    if (!network_.presence.empty())
      presence = FloatsOf(*FindOutput(outputs, network_.presence)).front();
    const std::vector<FoundPoint> found = Decode(outputs);
    std::vector<Keypoint> points;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!network_.landmarks[i] || !IsNearCrop(found[i].crop_px)) continue;
      const double score = are_probabilities ? found[i].score : Sigmoid(found[i].score);
      points.push_back({.landmark = *network_.landmarks[i],
                        .px = (map * found[i].crop_px).cast<float>(),
                        .score = static_cast<float>(std::clamp(presence * score, 0.0, 1.0))});
    }
    return points;
  }

  const std::filesystem::path file_;
  cv::dnn::Net net_;
  std::vector<std::string> names_;
  NetworkDescription network_;
  cv::Mat crop_;
};

PoseNetwork::PoseNetwork(const std::filesystem::path& model)
    : impl_(std::make_unique<Impl>(model)) {}
PoseNetwork::~PoseNetwork() = default;
PoseNetwork::PoseNetwork(PoseNetwork&&) noexcept = default;

const NetworkDescription& PoseNetwork::description() const { return impl_->description(); }

std::vector<Keypoint> PoseNetwork::Find(ImageView<const Bgr> picture, const PictureRegion& region) {
  return impl_->Find(picture, region);
}

}  // namespace mocap

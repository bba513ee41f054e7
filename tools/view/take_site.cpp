#include "tools/view/take_site.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "daemon/base/json.h"
#include "daemon/messages/messages.h"
#include "daemon/messages/reduced_picture.h"
#include "drivers/quoted.h"
#include "drivers/take/input_file.h"
#include "drivers/take/keypoint_table.h"
#include "tools/kinematics/gait_events.h"
#include "tools/page/picture_lines.h"
#include "tools/report/body_outline.h"
#include "tools/results/export_axes.h"
#include "tools/results/message_body.h"
#include "tools/view/camera_json.h"
#include "tools/view/drawn_body.h"
#include "tools/view/shown_keypoints.h"
#include "tools/view/wire.h"

namespace mocap {
namespace {

constexpr std::size_t kMostPosesAtOnce = 2000;
constexpr int kWidest_px = 800;
constexpr int kJpegQuality = 85;
constexpr int kTruthPerson = 255;

/// The fault of a request, for the client.
struct WrongRequest {
  std::string why;
};

/// Parses a number from 0 to `most`. @throws WrongRequest
std::size_t NumberOf(const ViewRequest& request, const std::string& name, std::size_t most) {
  const auto found = request.query.find(name);
  const std::string text = found == request.query.end() ? "" : found->second;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  if (is_number && number <= most) return number;
  throw WrongRequest{name + " is " + Quoted(text) + "; expected 0 to " + std::to_string(most)};
}

std::string NameOf(const std::filesystem::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with("person-") ? folder.parent_path().filename().string() + '/' + name : name;
}

std::vector<KeypointView> KeypointsIn(const std::filesystem::path& take) {
  const std::filesystem::path table = take / "keypoints.csv";
  return std::filesystem::exists(table) ? ReadKeypoints(table) : std::vector<KeypointView>();
}

/// Index of the row nearest to each of `times`, within a tolerance; -1: none.
template <typename Rows>
std::vector<int> NearestRows(const std::vector<std::int64_t>& times, const Rows& rows,
                             std::int64_t tolerance_ns) {
  std::vector<int> nearest;
  std::size_t row = 0;
  const auto apart_ns = [&](std::size_t of, std::int64_t time_ns) {
    return std::abs(rows[of].timestamp_ns - time_ns);
  };
  for (const std::int64_t time_ns : times) {
    while (row + 1 < rows.size() && apart_ns(row + 1, time_ns) <= apart_ns(row, time_ns)) ++row;
    const bool is_near = row < rows.size() && apart_ns(row, time_ns) <= tolerance_ns;
    nearest.push_back(is_near ? static_cast<int>(row) : -1);
  }
  return nearest;
}

Json ScoredJoints() {
  Json joints = Json::array();
  for (const Point point : kScoredPoints) {
    joints.push_back(kPointNames[static_cast<std::size_t>(point)]);
  }
  return joints;
}

/// Errors by frame; unknown ones are NaN.
struct FrameErrors {
  explicit FrameErrors(std::size_t frames)
      : mean_mm(frames, kUnknown),
        joint_mm(kScoredPoints.size(), std::vector<double>(frames, kUnknown)) {}

  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> mean_mm;
  std::vector<std::vector<double>> joint_mm;  ///< By scored joint.
};

FrameErrors ErrorsOf(const Accuracy& accuracy, const std::vector<int>& rows) {
  FrameErrors errors(rows.size());
  std::map<int, std::size_t> frame_of_row;
  for (std::size_t frame = 0; frame < rows.size(); ++frame) frame_of_row[rows[frame]] = frame;
  for (const FrameError& error : accuracy.frames) {
    const auto found = frame_of_row.find(error.pose);
    if (found == frame_of_row.end()) continue;
    errors.mean_mm[found->second] = error.point_mm.mean();
    for (std::size_t joint = 0; joint < kScoredPoints.size(); ++joint) {
      errors.joint_mm[joint][found->second] = error.point_mm[static_cast<int>(joint)];
    }
  }
  return errors;
}

/// Foot strikes and foot offs, at the page's times.
Json EventsJson(const Result& result) {
  Json events = Json::array();
  for (const GaitEvent& event : GaitEventsOf(result)) {
    const double start_ms = static_cast<double>(result.poses.front().timestamp_ns) / kNsPerMs;
    events.push_back({{"time_ms", start_ms + 1000 * event.time_s},
                      {"side", NameOf(event.side)},
                      {"event", NameOf(event.kind)}});
  }
  return events;
}

Json ResultJson(const std::string& name, const Evaluation& evaluation,
                const std::vector<int>& rows) {
  Json states = Json::array(), residuals = Json::array(), probabilities = Json::array();
  for (const int at : rows) {
    const PoseRow* row = at < 0 ? nullptr : &evaluation.result.poses[static_cast<std::size_t>(at)];
    states.push_back(row ? Json(static_cast<int>(row->state)) : Json());
    residuals.push_back(row && row->has_pose ? Json(row->residual_mm) : Json());
    const bool is_known = row && row->has_pose && !std::isnan(row->probability);
    probabilities.push_back(is_known ? Json(row->probability) : Json());
  }
  Json json{{"name", name},
            {"body", Json::parse(BodyJson(evaluation.result.body, PartsFromPoints()))},
            {"states", std::move(states)},
            {"residual_mm", std::move(residuals)},
            {"probability", std::move(probabilities)},
            {"error_mm", Json::array()},
            {"joints", Json::array()},
            {"joint_error_mm", Json::array()},
            {"events", EventsJson(evaluation.result)}};
  if (!evaluation.accuracy) return json;
  const FrameErrors errors = ErrorsOf(*evaluation.accuracy, rows);
  json["error_mm"] = errors.mean_mm;
  json["joints"] = ScoredJoints();
  json["joint_error_mm"] = errors.joint_mm;
  return json;
}

}  // namespace

TakeSite::TakeSite(const std::filesystem::path& take,
                   const std::vector<std::filesystem::path>& results,
                   const std::optional<std::string>& prefix)
    : pictures_(take),
      keypoints_(KeypointsIn(take)),
      truth_(ReadTruePeople(take)),
      remarks_(pictures_.remarks()) {
  const TakeIdentity identity(take);
  for (const std::filesystem::path& result : results) Add(identity, PlainFolder(result), prefix);
  ChooseTimes();
}

void TakeSite::Accept(const TakeIdentity& take, const std::filesystem::path& result, Result& read) {
  take.Require(result, read);
  remarks_.insert(remarks_.end(), read.remarks.begin(), read.remarks.end());
}

void TakeSite::Add(const TakeIdentity& take, const std::filesystem::path& result,
                   const std::optional<std::string>& prefix) {
  const std::size_t group = groups_++;
  if (!IsOfPeople(result)) {
    const bool is_log = !std::filesystem::is_directory(result);
    Result read = ReadResult(result, is_log ? prefix : std::nullopt);
    Accept(take, result, read);
    results_.push_back({NameOf(result), EvaluateOne(std::move(read), truth_), group});
    return;
  }
  PeopleResults people = ReadPeople(result);
  for (auto& [name, read] : people) Accept(take, result / name, read);
  PeopleEvaluation evaluation = EvaluatePeople(std::move(people), truth_);
  for (TrackedPerson& person : evaluation.people) {
    results_.push_back({NameOf(result / person.name), std::move(person.evaluation), group,
                        person.name, person.true_person});
  }
}

void TakeSite::ChooseTimes() {
  // One of several people may be present only briefly.
  if (results_.empty() || !results_.front().person.empty()) {
    times_ns_ = pictures_.Times();
  } else {
    for (const PoseRow& row : results_.front().evaluation.result.poses) {
      times_ns_.push_back(row.timestamp_ns);
    }
  }
  const std::int64_t tolerance_ns = std::llround(0.5e9 / pictures_.fps_nominal());
  for (ShownResult& result : results_) {
    result.rows = NearestRows(times_ns_, result.evaluation.result.poses, tolerance_ns);
  }
}

ViewReply TakeSite::Answer(const ViewRequest& request) {
  constexpr const char* kBinary = "application/octet-stream";
  if (request.method != "GET") return {404, "", ""};
  try {
    if (request.path == "/take.json") return {200, "application/json", TakeJson()};
    if (request.path == "/poses.bin") return {200, kBinary, Poses(request)};
    if (request.path == "/pictures.bin") return {200, kBinary, Pictures(request)};
  } catch (const WrongRequest& wrong) {
    return {400, "text/plain; charset=utf-8", wrong.why + '\n'};
  }
  return {404, "", ""};
}

const PoseRow* TakeSite::RowOf(const ShownResult& result, std::size_t frame) const {
  const int row = result.rows[frame];
  return row < 0 ? nullptr : &result.evaluation.result.poses[static_cast<std::size_t>(row)];
}

std::string TakeSite::TakeJson() const {
  Json times = Json::array();
  for (const std::int64_t time_ns : times_ns_) {
    times.push_back(static_cast<double>(time_ns) / kNsPerMs);
  }
  Json json{{"name", pictures_.name()},
            {"fps", pictures_.fps_nominal()},
            {"studio", Json::parse(StudioJson(pictures_.name(), pictures_.cameras(),
                                              pictures_.FirstPoses()))},
            {"times_ms", std::move(times)},
            {"results", Json::array()},
            {"truth", nullptr}};
  if (!truth_.empty()) json["truth"] = {{"joints", ScoredJoints()}, {"people", Json::array()}};
  for (const TruePerson& person : truth_) json["truth"]["people"].push_back(person.name);
  for (const ShownResult& result : results_) {
    Json one = ResultJson(result.name, result.evaluation, result.rows);
    one["group"] = result.group;
    one["person"] = result.person;
    one["true_person"] = result.true_person < 0 ? Json() : Json(result.true_person);
    json["results"].push_back(std::move(one));
  }
  return JsonText(json);
}

const TakeSite::ShownResult* TakeSite::ResultOf(const ViewRequest& request) const {
  // A take without results has pictures and truth.
  if (results_.empty()) return nullptr;
  return &results_[NumberOf(request, "result", results_.size() - 1)];
}

std::string TakeSite::Poses(const ViewRequest& request) const {
  const std::size_t from = NumberOf(request, "from", times_ns_.size());
  const std::size_t count = NumberOf(request, "count", kMostPosesAtOnce);
  const bool is_truth = request.query.contains("truth") && !truth_.empty();
  const TruePerson* truth =
      is_truth ? &truth_[NumberOf(request, "truth", truth_.size() - 1)] : nullptr;
  const ShownResult* result = is_truth ? nullptr : ResultOf(request);
  std::string bytes;
  for (std::size_t frame = from; frame < std::min(from + count, times_ns_.size()); ++frame) {
    if (truth) bytes += TruthOf(*truth, frame);
    if (result) bytes += PoseOf(*result, frame);
  }
  return bytes;
}

std::string TakeSite::PoseOf(const ShownResult& result, std::size_t frame) const {
  DrawnPose drawn;
  if (const PoseRow* row = RowOf(result, frame)) {
    drawn.row = *row;
    drawn.capsules = CapsulesFromPoints(*row, result.evaluation.result.body.sizes);
  }
  drawn.row.frame = static_cast<std::int64_t>(frame);
  drawn.row.timestamp_ns = times_ns_[frame];
  return PoseBytes(drawn);
}

std::string TakeSite::TruthOf(const TruePerson& person, std::size_t frame) const {
  DrawnPose drawn;
  drawn.person = kTruthPerson;
  drawn.row.frame = static_cast<std::int64_t>(frame);
  drawn.row.timestamp_ns = times_ns_[frame];
  drawn.row.points_W.setConstant(std::numeric_limits<double>::quiet_NaN());
  const std::int64_t tolerance_ns = std::llround(0.5e9 / pictures_.fps_nominal());
  const int nearest = NearestRows({times_ns_[frame]}, person.truth.frames, tolerance_ns).front();
  if (nearest < 0) return PoseBytes(drawn);
  drawn.row.state = CaptureState::kTracking;
  drawn.row.has_pose = true;
  const ScoredFrame& truth = person.truth.frames[static_cast<std::size_t>(nearest)];
  for (int i = 0; i < kScoredPointCount; ++i) {
    drawn.row.points_W.col(static_cast<int>(kScoredPoints[static_cast<std::size_t>(i)])) =
        truth.points_W.col(i);
  }
  return PoseBytes(drawn);
}

std::string TakeSite::Pictures(const ViewRequest& request) {
  if (times_ns_.empty()) return {};
  const std::size_t frame = NumberOf(request, "frame", times_ns_.size() - 1);
  const ShownResult* result = ResultOf(request);
  const std::scoped_lock lock(mutex_);
  const std::vector<TakePicture> pictures = pictures_.At(times_ns_[frame]);
  const VoxelGrid grid = pictures_.Carve(pictures);
  std::string bytes;
  for (const TakePicture& picture : pictures) {
    std::vector<DrawnOutlines> bodies;
    if (result) bodies = BodiesOf(*result, frame, picture);
    bytes += DrawnOver(picture, pictures_.UnknownShareOf(picture, grid), std::move(bodies));
    bytes += KeypointsOver(picture);
  }
  if (grid.size().isZero()) return bytes;
  voxels_t voxels;
  FillVoxelGrid(grid, times_ns_[frame], static_cast<std::int64_t>(frame), voxels);
  return bytes + VoxelBytes(voxels, 0);
}

// Bodies of everyone who was tracked together.
std::vector<DrawnOutlines> TakeSite::BodiesOf(const ShownResult& chosen, std::size_t frame,
                                              const TakePicture& picture) const {
  const CameraCalibration& camera = pictures_.cameras()[static_cast<std::size_t>(picture.camera)];
  std::vector<DrawnOutlines> bodies;
  for (std::size_t i = 0; i < results_.size(); ++i) {
    const ShownResult& result = results_[i];
    const BodySizes& sizes = result.evaluation.result.body.sizes;
    const PoseRow* row = RowOf(result, frame);
    if (result.group != chosen.group || !row || !IsTracked(*row) || !AreSizes(sizes)) continue;
    bodies.push_back({.person = result.person.empty() ? DrawnOutlines::kAlone : static_cast<int>(i),
                      .lines = PartOutlines(*row, sizes, camera, picture.X_CW)});
  }
  return bodies;
}

std::string TakeSite::KeypointsOver(const TakePicture& picture) const {
  const std::string& camera = pictures_.cameras()[static_cast<std::size_t>(picture.camera)].name;
  ShownKeypoints shown;
  auto view = std::ranges::lower_bound(keypoints_, picture.capture_ns - kKeypointsShownNs, {},
                                       &KeypointView::capture_ns);
  for (; view != keypoints_.end() && view->capture_ns <= picture.capture_ns; ++view) {
    if (view->camera == camera) shown.Add(*view);
  }
  return shown.Bytes(picture.camera);
}

std::string TakeSite::DrawnOver(const TakePicture& picture, std::optional<double> unknown_share,
                                std::vector<DrawnOutlines> bodies) {
  ReducePicture(picture.image, ReductionFor(picture.image.width(), kWidest_px), reduced_);
  encoder_.Encode(reduced_.view(), kJpegQuality, jpeg_);
  DrawnPicture drawn{.camera = picture.camera,
                     .width_px = picture.image.width(),
                     .height_px = picture.image.height(),
                     .capture_ms = static_cast<double>(picture.capture_ns) / kNsPerMs,
                     .silhouette = {},
                     .unknown = {},
                     .unknown_share = unknown_share,
                     .bodies = std::move(bodies),
                     .jpeg = jpeg_};
  if (picture.trimap) {
    drawn.silhouette = SilhouetteLines(picture.trimap->person, 1);
    drawn.unknown = SilhouetteLines(picture.trimap->unknown, 1);
  }
  return PictureBytes(drawn);
}

}  // namespace mocap

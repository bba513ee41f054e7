#include "tools/import/import_take.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <thread>

#include "config/camera_files.h"
#include "config/open_studio.h"
#include "core/errors.h"
#include "core/reconstruction/silhouette/segmenter.h"
#include "drivers/take/calibration_file.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_layout.h"
#include "drivers/take/take_writer.h"
#include "drivers/take/text_file.h"
#include "drivers/take/toml_text.h"
#include "drivers/take/unfinished_folder.h"
#include "drivers/take/video_copy.h"
#include "drivers/take/video_reader.h"
#include "drivers/take/video_writer.h"
#include "drivers/utc_time.h"
#include "tools/import/sampled_pictures.h"
#include "tools/import/video_check.h"
#include "tools/job_pool.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

/// Motion is compared over this much of each recording, from its beginning.
constexpr double kComparedMotion_s = 120;
/// Takes without a date begin here: 0 might mean that there is no time.
constexpr std::int64_t kBeginOfTake_ns = 1'000'000'000;

void Tell(const std::string& what) {
  if (isatty(STDERR_FILENO)) std::fprintf(stderr, "%s\n", what.c_str());
}

/// Does the same for all cameras, as many at once as there are processors.
template <typename Work>
void ForEachCamera(std::vector<ImportedCamera>& cameras, const Work& work) {
  std::vector<std::function<void()>> jobs;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    jobs.emplace_back([&work, &cameras, i] { work(cameras[i], i); });
  DoAll(jobs, static_cast<int>(std::thread::hardware_concurrency()));
}

TimedVideo TimedOf(const ImportedCamera& camera) {
  return {camera.calibration.name, camera.file, camera.index.times_ns};
}

void FindRoom(const std::filesystem::path& folder, ImportedCamera& camera) {
  if (camera.clip.empty()) {
    camera.room = FindRoomInVideo(TimedOf(camera), folder);
    return;
  }
  const VideoIndex index = ReadVideoIndex(camera.clip, EndIfStopAsked);
  camera.room = TakeRoomFromClip({camera.calibration.name, camera.clip, index.times_ns},
                                 TimedOf(camera), folder);
}

/// Follows the silhouettes of a camera. @param seen  with a place for each camera.
void FollowMotion(const TakeLayout& layout, const ImportedCamera& camera, std::size_t place,
                  MotionSeen& seen) {
  const CameraCalibration& calibration = camera.calibration;
  const auto background =
      OpenCameraBackground(layout.BackgroundVideo(calibration.name), {}, calibration)();
  Segmenter segmenter(calibration, background, {});
  CameraHulls everybody = NoHulls(calibration), largest = everybody;
  const std::vector<std::int64_t>& times_ns = camera.index.times_ns;
  std::vector<std::size_t> frames;
  for (std::size_t i = 0; i < times_ns.size(); ++i)
    if (TimedOf(camera).SecondsOf(i) < kComparedMotion_s) frames.push_back(i);
  Trimap trimap;
  VisitFrames(camera.file, times_ns, frames, [&](std::size_t frame, ImageView<const Bgr> picture) {
    segmenter.Segment(picture, {}, trimap);
    const double time_s = static_cast<double>(times_ns[frame]) / 1e9;
    everybody.frames.push_back({time_s, HullOf(trimap.person, calibration)});
    largest.frames.push_back({time_s, HullOf(LargestPart(trimap.person), calibration)});
    return true;
  });
  seen.everybody[place] = std::move(everybody);
  seen.largest[place] = std::move(largest);
}

std::vector<CameraCalibration> CalibrationsOf(const std::vector<ImportedCamera>& cameras) {
  std::vector<CameraCalibration> calibrations;
  for (const ImportedCamera& camera : cameras) calibrations.push_back(camera.calibration);
  return calibrations;
}

std::vector<SyncVideo> SyncVideosOf(const std::vector<ImportedCamera>& cameras) {
  const std::vector<SoundTravel> travels = SoundTravels(CalibrationsOf(cameras));
  std::vector<SyncVideo> videos;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    videos.push_back({cameras[i].calibration.name, cameras[i].file, &cameras[i].index, travels[i]});
  return videos;
}

/// When the take's clock is 0, since the Unix epoch [ns]; empty: no file tells.
std::optional<std::int64_t> EpochOf(const std::vector<ImportedCamera>& cameras) {
  for (const ImportedCamera& camera : cameras) {
    const auto created = CreationTimeFromText(camera.index.created);
    if (!created) continue;
    const double first_s = camera.clock.TimeOf(camera.index.times_ns.front());
    return created->epoch_ns - std::llround(first_s * 1e9);
  }
  return std::nullopt;
}

/// Gives each frame its time in the take.
void PlaceFrames(std::vector<ImportedCamera>& cameras) {
  double begin_s = cameras[0].clock.TimeOf(cameras[0].index.times_ns.front());
  for (const ImportedCamera& camera : cameras)
    begin_s = std::min(begin_s, camera.clock.TimeOf(camera.index.times_ns.front()));
  const std::int64_t begin_ns = std::llround(begin_s * 1e9);
  const std::optional<std::int64_t> epoch_ns = EpochOf(cameras);
  const bool has_date = epoch_ns && *epoch_ns + begin_ns > kBeginOfTake_ns;
  const std::int64_t shift_ns = has_date ? *epoch_ns : kBeginOfTake_ns - begin_ns;
  for (ImportedCamera& camera : cameras) {
    for (const std::int64_t time_ns : camera.index.times_ns)
      camera.times_ns.push_back(shift_ns + std::llround(camera.clock.TimeOf(time_ns) * 1e9));
  }
}

/// Number of frames that come before a video's first one that can be decoded.
std::size_t UndecodableFrames(VideoReader& video, std::span<const std::int64_t> times_ns) {
  video.Skip();
  const std::optional<std::int64_t> first_ns = video.time_ns();
  video.Rewind();
  if (!first_ns) return 0;
  return static_cast<std::size_t>(std::ranges::lower_bound(times_ns, *first_ns) - times_ns.begin());
}

/// Codes pictures anew, without loss: Matroska does not hold them as they are. A picture that
/// cannot be decoded is that before it.
void Recode(VideoReader& video, double rate_hz, const std::filesystem::path& to) {
  VideoWriter writer(to, video.width_px(), video.height_px(), rate_hz, VideoPixels::kBgr,
                     VideoCodec::kFfv1);
  ImageView<const Bgr> picture;
  for (VideoStatus status; (status = video.Read(picture)) != VideoStatus::kEnd;) {
    EndIfStopAsked();
    if (!picture.empty()) writer.Write(picture);
  }
  writer.Finish();
}

void WriteTable(const std::filesystem::path& file, std::span<const std::int64_t> times_ns) {
  std::string text = "frame,timestamp_ns\n";
  for (std::size_t i = 0; i < times_ns.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{},{}\n", i, times_ns[i]);
  WriteText(file, text);
}

void WriteCamera(const TakeLayout& layout, ImportedCamera& camera) {
  const std::string& name = camera.calibration.name;
  const std::filesystem::path to = layout.Video(name);
  VideoReader video(camera.file);
  std::size_t lost = 0;
  if (CopyVideo(camera.file, to, video.turn(), EndIfStopAsked)) {
    VideoReader copy(to);
    lost = UndecodableFrames(copy, ReadVideoIndex(to, EndIfStopAsked).times_ns);
  } else {
    lost = UndecodableFrames(video, camera.index.times_ns);
    Recode(video, camera.rate_hz, to);
  }
  camera.times_ns.erase(camera.times_ns.begin(),
                        camera.times_ns.begin() + static_cast<std::ptrdiff_t>(lost));
  WriteTable(layout.Table(name), camera.times_ns);
}

std::string DescriptionOf(const std::string& name, std::int64_t begin_ns,
                          const std::vector<ImportedCamera>& cameras) {
  std::string names, videos, methods;
  double rate_hz = 0;
  for (const ImportedCamera& camera : cameras) {
    const std::string comma = names.empty() ? "" : ", ";
    names += comma + TomlText(camera.calibration.name);
    videos += comma + TomlText(camera.file.filename().string());
    methods += comma + TomlText(kSyncNames[static_cast<int>(camera.clock.method)]);
    rate_hz = std::max(rate_hz, camera.rate_hz);
  }
  std::string text = fmt::format(
      "name = {}\nfps_nominal = {}\ncameras = [{}]\nbegin_ns = {}\nsource = \"imported\"\n",
      TomlText(name), TomlNumber(std::round(rate_hz * 1000) / 1000), names, begin_ns);
  return text + fmt::format("videos = [{}]\nsynchronized_by = [{}]\n", videos, methods);
}

void WriteTake(const TakeLayout& layout, const std::string& name, std::int64_t begin_ns,
               std::vector<ImportedCamera>& cameras) {
  WriteCalibration(layout.Calibration(), CalibrationsOf(cameras));
  WriteText(layout.Description(), DescriptionOf(name, begin_ns, cameras));
  for (ImportedCamera& camera : cameras) {
    Tell("writing " + camera.calibration.name);
    WriteCamera(layout, camera);
  }
}

}  // namespace

ImportedTake ImportTake(const ImportRequest& request) {
  const std::filesystem::path folder = PlainFolder(request.out);
  const std::filesystem::path partial = folder.string() + ".partial";
  RequireNewTake(folder, partial);
  ImportedTake take;
  take.cameras = CheckVideos(request, take.remarks);
  std::vector<ImportedCamera>& cameras = take.cameras;
  const std::vector<SyncVideo> videos = SyncVideosOf(cameras);
  SyncRequest sync = request.sync;
  std::vector<std::string> names;
  for (const SyncVideo& video : videos) names.push_back(video.camera);
  if (!request.offsets.empty()) sync.given_s = ParseOffsets(request.offsets, names);
  Tell("comparing clocks and sound");
  std::vector<CameraClock> clocks = SyncByFiles(videos, sync, take.remarks, EndIfStopAsked);
  const TakeLayout layout{partial};
  std::filesystem::create_directories(layout.Background());
  UnfinishedFolder unfinished(partial);
  Tell("looking for the empty room");
  ForEachCamera(
      cameras, [&](ImportedCamera& camera, std::size_t) { FindRoom(layout.Background(), camera); });
  if (NeedsMotion(clocks)) {
    Tell("comparing motion");
    MotionSeen seen{std::vector<CameraHulls>(cameras.size()),
                    std::vector<CameraHulls>(cameras.size())};
    ForEachCamera(cameras, [&](ImportedCamera& camera, std::size_t i) {
      FollowMotion(layout, camera, i, seen);
    });
    SyncByMotion(videos, seen, sync, take.remarks, EndIfStopAsked, clocks);
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) cameras[i].clock = clocks[i];
  PlaceFrames(cameras);
  const CommonTime common = RequireCommonTime(cameras, take.remarks);
  take.common_s = common.length_s();
  for (ImportedCamera& camera : cameras)
    std::erase_if(camera.times_ns, [&](std::int64_t time_ns) { return time_ns > common.end_ns; });
  MeasureApart(cameras);
  WriteTake(layout, folder.filename().string(), common.begin_ns, cameras);
  OpenTake(partial, {});  // Whatever would keep it from being tracked is an error of this command.
  std::filesystem::rename(partial, folder);
  unfinished.Finish();
  return take;
}

}  // namespace mocap

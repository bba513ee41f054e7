#include "tools/simulate.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "daemon/base/number_option.h"
#include "drivers/simulation/motion.h"
#include "drivers/simulation/simulated_board.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/take/input_file.h"
#include "drivers/take/take_writer.h"

namespace mocap {
namespace {

const std::map<std::string, BoardPlace> kBoardPlaces = {{"carried", BoardPlace::kCarried},
                                                        {"floor", BoardPlace::kOnFloor},
                                                        {"desk", BoardPlace::kOnDesk}};

struct SimulateOptions {
  std::filesystem::path out;
  SimulatedStudioOptions studio = RecordedSimulation();
  std::string board;  ///< One of kBoardPlaces, or nothing: a person.
  int desk = 1;

  int frames() const { return static_cast<int>(std::lround(studio.seconds * studio.fps)); }
};

std::string Text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

TakeDescription Describe(const SimulateOptions& options,
                         const std::vector<CameraCalibration>& cameras) {
  TakeDescription description;
  description.name = PlainFolder(options.out).filename().string();
  description.fps_nominal = options.studio.fps;
  description.cameras = cameras;
  // The simulated time, so that the same options give the same bytes.
  description.notes = {{"created", "1970-01-01T00:16:40Z"}, {"source", "simulated"}};
  if (!options.board.empty()) {
    description.notes.emplace_back("board", "chess:8x5:100");
  } else {
    description.notes.emplace_back("motion", options.studio.motion);
    description.notes.emplace_back("stature_mm", Text(options.studio.stature_mm));
  }
  description.notes.emplace_back("seed", std::to_string(options.studio.seed));
  return description;
}

class Progress {
 public:
  explicit Progress(int total) : total_(total), shown_(isatty(STDERR_FILENO) != 0) {}
  ~Progress() {
    if (shown_) std::fputc('\n', stderr);
  }
  void Show(const char* what, int done) const {
    if (shown_) std::fprintf(stderr, "\r%s %d of %d \x1b[K", what, done, total_);
  }

 private:
  int total_;
  bool shown_;
};

void WriteBackgrounds(const SimulatedStudio& studio, TakeWriter& writer) {
  const int cameras = static_cast<int>(studio.cameras().size());
  const Progress progress(cameras);
  for (int c = 0; c < cameras; ++c) {
    progress.Show("background", c + 1);
    const std::vector<BackgroundFrame> frames = studio.Background(c);
    const auto count = static_cast<std::int64_t>(frames.size());
    for (std::int64_t i = 0; i < count; ++i)
      // Taken before the person came.
      writer.WriteBackground(c, frames[i].image.view(), studio.NominalTime(i - 2 * count),
                             frames[i].angles);
  }
}

void WriteFrames(const SimulateOptions& options, const SimulatedStudio& studio,
                 TakeWriter& writer) {
  const SimulatedTruth truth(options.studio);
  std::vector<std::unique_ptr<SimulatedCamera>> cameras;
  for (std::size_t c = 0; c < studio.cameras().size(); ++c) {
    cameras.push_back(studio.OpenCamera(static_cast<int>(c)));
    cameras.back()->Start();
  }
  const Progress progress(options.frames());
  for (int i = 0; i < options.frames(); ++i) {
    progress.Show("frame", i + 1);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      Frame frame;
      cameras[c]->Grab(frame, std::chrono::milliseconds(0));
      const int camera = static_cast<int>(c);
      writer.WriteFrame(camera, frame.image, frame.capture_ns, frame.angles);
      writer.WriteMask(camera, cameras[c]->TrueMask());
    }
    writer.WriteTruth(studio.NominalTime(i), truth.At(studio.NominalTime(i)));
  }
  writer.WriteTruthSizes(truth.Sizes());
}

void SimulatePerson(const SimulateOptions& options) {
  const SimulatedStudio studio(options.studio);
  TakeWriter writer(options.out, Describe(options, studio.cameras()));
  const std::vector<std::string> names(kSimulatedJointNames.begin(), kSimulatedJointNames.end());
  writer.SetTruthPoints(names);
  WriteBackgrounds(studio, writer);
  WriteFrames(options, studio, writer);
  writer.Finish();
}

void SimulateBoard(const SimulateOptions& options) {
  SimulatedBoard board(options.studio, kBoardPlaces.at(options.board), options.desk);
  TakeWriter writer(options.out, Describe(options, board.cameras()));
  const Progress progress(options.frames());
  for (int i = 0; i < options.frames(); ++i) {
    progress.Show("frame", i + 1);
    for (int c = 0; c < options.studio.cameras; ++c)
      writer.WriteFrame(c, board.Paint(c, i), board.CaptureTime(c, i),
                        board.AnglesAt(c, board.CaptureTime(c, i)));
  }
  writer.Finish();
}

void Simulate(const SimulateOptions& options) {
  options.board.empty() ? SimulatePerson(options) : SimulateBoard(options);
}

}  // namespace

void AddSimulateCommand(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  options->studio.seconds = 4;
  CLI::App* command =
      app.add_subcommand("simulate", "Writes a take of a simulated studio, with truth");
  std::string motions;
  for (const std::string_view name : simulation::kMotionNames)
    motions += (motions.empty() ? "" : ", ") + std::string(name);
  command->add_option("--out", options->out, "Folder of the take to write")->required();
  command->add_option("--motion", options->studio.motion, "What the person does: " + motions)
      ->capture_default_str();
  command->add_option("--stature", options->studio.stature_mm, "Height of the person [mm]")
      ->check(NumberFrom(1000, 2100))
      ->capture_default_str();
  command->add_option("--seconds", options->studio.seconds, "Length of the take")
      ->check(NumberFrom(0.001, 86400))
      ->capture_default_str();
  command->add_option("--fps", options->studio.fps, "Frames a second")
      ->check(NumberFrom(1, 1000))
      ->capture_default_str();
  command->add_option("--cameras", options->studio.cameras, "Number of cameras")
      ->check(NumberFrom(1, 64))
      ->capture_default_str();
  command->add_option("--width", options->studio.width_px, "Of the pictures [pixels]")
      ->check(NumberFrom(16, 8192))
      ->capture_default_str();
  command->add_option("--height", options->studio.height_px, "Of the pictures [pixels]")
      ->check(NumberFrom(16, 8192))
      ->capture_default_str();
  command->add_flag("--pan-tilt", options->studio.pan_tilt,
                    "Cameras on heads that follow the person");
  command->add_option("--seed", options->studio.seed, "Person, clothes, room, lenses and path")
      ->capture_default_str();
  command
      ->add_option("--board", options->board,
                   "Instead of a person a chessboard of 8x5 inner corners, 100 mm")
      ->check(CLI::IsMember(kBoardPlaces));
  command
      ->add_option("--desk", options->desk,
                   "Where the desk stands: each number is another place; heads look about it")
      ->capture_default_str();
  command->callback([options] { Simulate(*options); });
}

}  // namespace mocap

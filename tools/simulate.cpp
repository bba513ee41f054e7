#include "tools/simulate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "core/errors.h"
#include "daemon/base/choice_option.h"
#include "daemon/base/disk_space.h"
#include "daemon/base/number_option.h"
#include "drivers/nearest_name.h"
#include "drivers/printable_text.h"
#include "drivers/simulation/simulated_board.h"
#include "drivers/simulation/simulated_studio.h"
#include "drivers/take/input_file.h"
#include "drivers/take/picture_coder.h"
#include "drivers/take/take_writer.h"
#include "drivers/take/unfinished_folder.h"
#include "drivers/virtual_studio/motions/company.h"
#include "drivers/virtual_studio/truth.h"
#include "tools/stop_on_signals.h"

namespace mocap {
namespace {

const std::map<std::string, BoardPlace> kBoardPlaces = {{"carried", BoardPlace::kCarried},
                                                        {"floor", BoardPlace::kOnFloor},
                                                        {"desk", BoardPlace::kOnDesk}};

std::vector<std::string> BoardPlaceNames() {
  std::vector<std::string> names;
  for (const auto& [name, place] : kBoardPlaces) names.push_back(name);
  return names;
}

struct SimulateOptions {
  std::filesystem::path out;
  SimulatedStudioOptions studio = RecordedSimulation();
  std::string board;  ///< One of kBoardPlaces; empty: a person.
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
  // Simulated time, so that the same options give the same bytes.
  description.notes = {{"created", "1970-01-01T00:16:40Z"}, {"source", "simulated"}};
  if (!options.board.empty()) {
    description.notes.emplace_back("board", "chess:8x5:100");
  } else {
    description.notes.emplace_back("motion", options.studio.motion);
    if (options.studio.people > 1)
      description.notes.emplace_back("people", std::to_string(options.studio.people));
    description.notes.emplace_back("stature_mm", Text(options.studio.stature_mm));
    if (options.studio.contrast > 0)
      description.notes.emplace_back("contrast", Text(options.studio.contrast));
    if (options.studio.soft_shadows) description.notes.emplace_back("shadows", "soft");
    if (options.studio.misled_share > 0)
      description.notes.emplace_back("misled", Text(options.studio.misled_share));
    if (options.studio.apart_s > 0)
      description.notes.emplace_back("apart_s", Text(options.studio.apart_s));
    if (options.studio.crf)
      description.notes.emplace_back("crf", std::to_string(*options.studio.crf));
  }
  description.notes.emplace_back("seed", std::to_string(options.studio.seed));
  return description;
}

class SimulationProgress {
 public:
  explicit SimulationProgress(int total) : total_(total), shown_(isatty(STDERR_FILENO) != 0) {}
  ~SimulationProgress() {
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
  const SimulationProgress progress(cameras);
  for (int c = 0; c < cameras; ++c) {
    progress.Show("background", c + 1);
    const std::vector<BackgroundFrame> frames = studio.Background(c);
    const auto count = static_cast<std::int64_t>(frames.size());
    EndIfStopAsked();
    for (std::int64_t i = 0; i < count; ++i)
      // Captured before the person came.
      writer.WriteBackground(c, frames[i].image.view(), studio.NominalTime(i - 2 * count),
                             frames[i].angles);
  }
}

// Truth of a single person in every frame. With several, of each person's frames in the room.
class TruthOfPeople {
 public:
  TruthOfPeople(const SimulatedStudioOptions& options, const SimulatedStudio& studio)
      : studio_(studio), truth_(options), stays_(options.people) {}

  void Write(std::int64_t frame, TakeWriter& writer) {
    const std::int64_t time_ns = studio_.NominalTime(frame);
    const int people = static_cast<int>(stays_.size());
    for (int i = 0; i < people; ++i) {
      if (people == 1 || IsThere(i, frame)) WriteRow(frame, time_ns, i, writer);
    }
  }

  static TruthColumns Columns() {
    return {.points = {kSimulatedJointNames.begin(), kSimulatedJointNames.end()},
            .rotations = {kTurnedSegmentNames.begin(), kTurnedSegmentNames.end()},
            .contacts = {kContactNames.begin(), kContactNames.end()}};
  }

  void Finish(TakeWriter& writer) const {
    const int people = static_cast<int>(stays_.size());
    for (int i = 0; i < people; ++i) writer.WriteTruthSizes(truth_.Sizes(i), i);
    if (people > 1) writer.AddPeople(stays_);
  }

 private:
  void WriteRow(std::int64_t frame, std::int64_t time_ns, int person, TakeWriter& writer) const {
    std::array<Vector3, kTurnedSegmentNames.size()> rotations;
    std::ranges::transform(truth_.RotationsAt(time_ns, person), rotations.begin(), LogRotation);
    writer.WriteTruth(frame, time_ns,
                      {.points_W = truth_.At(time_ns, person),
                       .rotations = rotations,
                       .contacts = truth_.ContactsAt(time_ns, person)},
                      person);
  }

  static void Extend(std::vector<FrameSpan>& spans, std::int64_t frame) {
    if (spans.empty() || spans.back().last + 1 < frame) spans.push_back({frame, frame});
    spans.back().last = frame;
  }

  bool IsThere(int person, std::int64_t frame) {
    const PersonPresence presence = studio_.PresenceOf(person, studio_.NominalTime(frame));
    PersonStay& stay = stays_[person];
    if (presence.in_room) Extend(stay.in_room, frame);
    if (presence.whole) Extend(stay.whole, frame);
    if (presence.whole && presence.pictures >= kCoveringPictures) Extend(stay.covered, frame);
    return presence.in_room;
  }

  const SimulatedStudio& studio_;
  const SimulatedTruth truth_;
  std::vector<PersonStay> stays_;
};

void WriteFrames(const SimulateOptions& options, const SimulatedStudio& studio,
                 TakeWriter& writer) {
  TruthOfPeople truth(options.studio, studio);
  std::vector<std::unique_ptr<SimulatedCamera>> cameras;
  for (std::size_t c = 0; c < studio.cameras().size(); ++c) {
    cameras.push_back(studio.OpenCamera(static_cast<int>(c)));
    cameras.back()->Start();
  }
  const SimulationProgress progress(options.frames());
  for (int i = 0; i < options.frames(); ++i) {
    progress.Show("frame", i + 1);
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      Frame frame;
      cameras[c]->Grab(frame, std::chrono::milliseconds(0));
      EndIfStopAsked();
      const int camera = static_cast<int>(c);
      writer.WriteFrame(camera, frame.image, frame.capture_ns, frame.angles);
      writer.WriteMask(camera, cameras[c]->TrueMask());
    }
    truth.Write(i, writer);
  }
  truth.Finish(writer);
}

void SimulatePeople(const SimulateOptions& options) {
  const SimulatedStudio studio(options.studio);
  TakeWriter writer(options.out, Describe(options, studio.cameras()));
  UnfinishedFolder unfinished(writer.partial_folder());
  writer.SetTruthColumns(TruthOfPeople::Columns(), options.studio.people);
  WriteBackgrounds(studio, writer);
  WriteFrames(options, studio, writer);
  writer.Finish();
  unfinished.Finish();
}

void SimulateBoard(const SimulateOptions& options) {
  SimulatedBoard board(options.studio, kBoardPlaces.at(options.board), options.desk);
  TakeWriter writer(options.out, Describe(options, board.cameras()));
  UnfinishedFolder unfinished(writer.partial_folder());
  const SimulationProgress progress(options.frames());
  for (int i = 0; i < options.frames(); ++i) {
    progress.Show("frame", i + 1);
    EndIfStopAsked();
    for (int c = 0; c < options.studio.cameras; ++c)
      writer.WriteFrame(c, board.Paint(c, i), board.CaptureTime(c, i),
                        board.AnglesAt(c, board.CaptureTime(c, i)));
  }
  writer.Finish();
  unfinished.Finish();
}

void Simulate(const SimulateOptions& options) {
  StopOnSignals();
  options.board.empty() ? SimulatePeople(options) : SimulateBoard(options);
  fmt::print("{} of {}, {:.0f} MB: {}\n", Counted(options.frames(), "frame set"),
             Counted(options.studio.cameras, "camera"),
             static_cast<double>(BytesIn(options.out)) / 1e6, Printable(options.out.string()));
}

// Returns the one that asks for a board.
CLI::Option& AddBoardOptions(CLI::App& command, SimulateOptions& options) {
  CLI::Option* const board =
      command
          .add_option("--board", options.board,
                      "show a chessboard (8x5 inner corners, 100 mm squares) at this place instead "
                      "of people")
          ->check(OneOf(BoardPlaceNames()));
  command
      .add_option("--desk", options.desk,
                  "position number of the desk, for --board desk; pan-tilt heads scan around it")
      ->capture_default_str();
  return *board;
}

// What makes people hard to see. Nobody is there with a board.
void AddEvidenceOptions(CLI::App& command, CLI::Option& board, SimulatedStudioOptions& studio) {
  command
      .add_option("--contrast", studio.contrast,
                  "let clothes differ from wall and floor behind them by at most this many of 256 "
                  "grey values, in every picture")
      ->check(NumberFrom(5, 100))
      ->excludes(&board);
  command
      .add_flag("--soft-shadows", studio.soft_shadows,
                "let people cast shadows with wide penumbras on floor, walls and furniture")
      ->excludes(&board);
  command
      .add_option("--misled", studio.misled_share,
                  "share of the cameras that are misled, rounded up: to each, either shirts or "
                  "trousers look exactly like the empty room")
      ->check(NumberFrom(0, 1))
      ->excludes(&board);
  command
      .add_option("--apart", studio.apart_s,
                  "take the pictures of a set up to this far apart, as cameras without a trigger "
                  "do: at most half a period [s]")
      ->check(NumberFrom(0, 1))
      ->excludes(&board);
  command
      .add_option("--crf", studio.crf,
                  "code the pictures, with those of the empty room, by x264 at this constant rate "
                  "factor, and store them decoded")
      ->check(NumberFrom(0, PictureCoder::kMostCrf))
      ->excludes(&board);
}

}  // namespace

void AddSimulateCommand(CLI::App& app) {
  const auto options = std::make_shared<SimulateOptions>();
  options->studio.seconds = 4;
  CLI::App* command =
      app.add_subcommand("simulate", "Render a take of a simulated studio, with ground truth");
  const std::vector<std::string> motions(simulation::kCompanyMotionNames.begin(),
                                         simulation::kCompanyMotionNames.end());
  command->add_option("--out", options->out, "output take folder")->required();
  command
      ->add_option("--motion", options->studio.motion,
                   "motion of the people: " + ListedNames(motions))
      ->capture_default_str();
  command
      ->add_option("--people", options->studio.people,
                   "number of people; with several, paths cross (walk) or they shake hands (meet)")
      ->check(NumberFrom(1, simulation::kMostSimulatedPeople))
      ->capture_default_str();
  command->add_option("--stature", options->studio.stature_mm, "stature of the first person [mm]")
      ->check(NumberFrom(1000, 2100))
      ->capture_default_str();
  command->add_option("--seconds", options->studio.seconds, "length of the take [s]")
      ->check(NumberFrom(0.001, 86400))
      ->capture_default_str();
  command
      ->add_option("--begin", options->studio.begin_s,
                   "time within the motion at which the take begins [s]")
      ->check(NumberFrom(0, 86400))
      ->capture_default_str();
  command->add_option("--fps", options->studio.fps, "frames per second")
      ->check(NumberFrom(1, 1000))
      ->capture_default_str();
  command->add_option("--cameras", options->studio.cameras, "number of cameras")
      ->check(NumberFrom(1, 64))
      ->capture_default_str();
  command->add_option("--width", options->studio.width_px, "picture width [px]")
      ->check(NumberFrom(16, 8192))
      ->capture_default_str();
  command->add_option("--height", options->studio.height_px, "picture height [px]")
      ->check(NumberFrom(16, 8192))
      ->capture_default_str();
  command->add_flag("--varied", options->studio.varied,
                    "vary builds, hair, hats, clothes and loads as among real people");
  command->add_flag("--pan-tilt", options->studio.pan_tilt,
                    "put the cameras on pan-tilt heads that follow the first person");
  command
      ->add_option("--seed", options->studio.seed,
                   "random seed for people, clothes, room, intrinsics and paths")
      ->capture_default_str();
  CLI::Option& board = AddBoardOptions(*command, *options);
  AddEvidenceOptions(*command, board, options->studio);
  command->callback([options] { Simulate(*options); });
}

}  // namespace mocap

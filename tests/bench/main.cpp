// Runs the benchmarks, and tells of each how it compares with its peers.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "tools/report/report_page.h"

namespace mocap::bench {
namespace {

// What was measured, in microseconds, by the benchmark's whole name.
class Results : public benchmark::ConsoleReporter {
 public:
  Results() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      // With repetitions their median counts.
      const bool is_median = run.aggregate_name == "median";
      if (run.error_occurred || (run.run_type == Run::RT_Aggregate && !is_median)) continue;
      const double per_unit = 1e6 / benchmark::GetTimeUnitMultiplier(run.time_unit);
      us_[run.run_name.str()] = run.GetAdjustedCPUTime() * per_unit;
    }
    ConsoleReporter::ReportRuns(runs);
  }
  // Not a number where it was not measured.
  double Us(const std::string& name) const {
    const auto found = us_.find(name);
    return found == us_.end() ? std::nan("") : found->second;
  }

 private:
  std::map<std::string, double> us_;
};

struct Comparison {
  const char *what, *ours, *peer;
};
constexpr Comparison kComparisons[] = {
    {"segmentation, OpenCV MOG2", "SegmentFrame/height:480/cameras:6",
     "SegmentByMog2/height:480/cameras:6"},
    {"segmentation, OpenCV KNN", "SegmentFrame/height:480/cameras:6",
     "SegmentByKnn/height:480/cameras:6"},
    {"one camera alone, OpenCV MOG2", "SegmentFrame/height:480/cameras:1",
     "SegmentByMog2/height:480/cameras:1"},
    {"one camera alone, OpenCV KNN", "SegmentFrame/height:480/cameras:1",
     "SegmentByKnn/height:480/cameras:1"},
    {"segmentation, memcpy of the frame", "SegmentFrame/height:480/cameras:6", "CopyFrame/480"},
    {"carving, Open3D CarveSilhouette", "CarveSet/height:480/mm:25/cameras:6", "CarveByOpen3d"}};

void PrintComparisons(const Results& results) {
  std::printf("\n%-36s %12s %12s %10s\n", "against", "ours [us]", "theirs [us]", "ratio");
  for (const Comparison& c : kComparisons) {
    const double ours = results.Us(c.ours), theirs = results.Us(c.peer);
    if (std::isnan(ours) || std::isnan(theirs)) continue;
    std::printf("%-36s %12.1f %12.1f %10.2f\n", c.what, ours, theirs, theirs / ours);
  }
}

// One curve, from what was measured at each value.
Json Growth(const Results& results, const std::string& label, int figure,
            const std::vector<std::pair<double, std::string>>& measured) {
  Json x = Json::array(), y = Json::array();
  for (const auto& [at, name] : measured) {
    x.push_back(at);
    y.push_back(Rounded(results.Us(name) / 1e3));
  }
  return Series(label, figure, "line", y, {{"x", x}});
}

Json PlotOf(const std::string& x_label, const std::string& y_label, const Json& series) {
  return {{"x", {{"label", x_label}}},
          {"y", {{"label", y_label}}},
          {"height", 170},
          {"series", series}};
}

std::string GrowthPlots(const Results& results) {
  const auto carve = [](int height, int mm, int cameras) {
    return "CarveSet/height:" + std::to_string(height) + "/mm:" + std::to_string(mm) +
           "/cameras:" + std::to_string(cameras);
  };
  std::vector<std::pair<double, std::string>> segment, by_height, by_voxel, by_cameras;
  for (const int height : {240, 480, 720, 1080}) {
    const double megapixels = height * height * 4 / 3 * 1e-6;
    segment.emplace_back(megapixels,
                         "SegmentFrame/height:" + std::to_string(height) + "/cameras:6");
    by_height.emplace_back(megapixels, carve(height, 25, 6));
  }
  for (const int mm : {10, 15, 25, 50}) by_voxel.emplace_back(mm, carve(480, mm, 6));
  for (const int cameras : {2, 4, 6, 8}) by_cameras.emplace_back(cameras, carve(480, 25, cameras));
  const Json plots = {
      PlotOf("resolution [megapixels]", "ms",
             {Growth(results, "segmentation of a frame", 0, segment),
              Growth(results, "carving of six", 1, by_height)}),
      PlotOf("edge of a voxel [mm]", "ms",
             Json::array({Growth(results, "carving of six", 1, by_voxel)})),
      PlotOf("cameras", "ms", Json::array({Growth(results, "carving, 25 mm", 1, by_cameras)}))};
  return ReportHtml("How cost grows", "processor time",
                    Json::array({Figure("Cost", "of one frame set", plots)}));
}

std::string ManyCamerasPlots(const Results& results) {
  const auto of = [&](const std::string& label, int color, const std::string& benchmark) {
    std::vector<std::pair<double, std::string>> measured;
    for (const int cameras : {2, 4, 6, 8, 12, 16, 24, 32, 48, 64})
      measured.emplace_back(cameras, benchmark + "/cameras:" + std::to_string(cameras));
    return Growth(results, label, color, measured);
  };
  const Json plots = {
      PlotOf("cameras", "ms a set",
             {of("carving", 1, "CarveManySets"), of("tracking", 0, "TrackManySets"),
              of("shadows", 2, "CompleteManySets"), of("matching by time", 3, "MatchManySets")}),
      PlotOf("cameras", "ms a set",
             Json::array({of("one look of the health watch", 0, "CheckManyCameras")}))};
  return ReportHtml("The cost of many cameras", "processor time",
                    Json::array({Figure("Cost", "of a frame set", plots)}));
}

// Takes one of our own options out of the command line.
std::filesystem::path TakeOption(const std::string& option, int& argc, char** argv) {
  std::filesystem::path value;
  int kept = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.starts_with(option))
      value = argument.substr(option.size());
    else
      argv[kept++] = argv[i];
  }
  argc = kept;
  return value;
}

int Run(int argc, char** argv) {
  const std::filesystem::path plot = TakeOption("--plot=", argc, argv);
  const std::filesystem::path many_cameras = TakeOption("--plot-many-cameras=", argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  Results results;
  benchmark::RunSpecifiedBenchmarks(&results);
  PrintComparisons(results);
  if (!plot.empty()) std::ofstream(plot) << GrowthPlots(results);
  if (!many_cameras.empty()) std::ofstream(many_cameras) << ManyCamerasPlots(results);
  return 0;
}

}  // namespace
}  // namespace mocap::bench

int main(int argc, char** argv) { return mocap::bench::Run(argc, argv); }

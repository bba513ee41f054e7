#include "tools/comparison/comparison.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <random>

#include "core/degrees.h"
#include "tests/support/moving_body.h"
#include "tests/support/report_data.h"
#include "tests/support/setup_error.h"
#include "tests/support/temporary_folder.h"
#include "tools/comparison/comparison_report.h"
#include "tools/comparison/comparison_text.h"
#include "tools/interchange/export_format.h"

namespace mocap {
namespace {

using ::testing::ElementsAre;
using testing::GrownBody;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SetupErrorOf;
using testing::SwingingResult;

/// How another laboratory records: its frame, its start, its rate, its names, its noise.
struct Laboratory {
  RigidTransform X_LW = {};  ///< Of our world in its own.
  double start_s = 0, rate_hz = 100, noise_mm = 0;
  bool renames = false;
};
const Laboratory kElsewhere{{ExpRotation({0.4, -0.7, 1.9}), {812, -345, 120}}, 1.37, 100, 3, true};

/// Six uniform numbers' sum: nearly normal, and the same everywhere.
double NoiseOf(std::mt19937& random) {
  double sum = 0;
  for (int i = 0; i < 6; ++i) sum += static_cast<double>(random()) / 4294967296.0 - 0.5;
  return sum * std::sqrt(2.0);
}

/// The order in which a laboratory has the points.
std::vector<std::size_t> OrderOf(const Laboratory& laboratory) {
  std::vector<std::size_t> order(kPointCount);
  std::iota(order.begin(), order.end(), 0);
  if (laboratory.renames)
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = 7 * i % order.size();
  return order;
}

std::string NameIn(const Laboratory& laboratory, std::size_t place, std::size_t point) {
  return laboratory.renames ? fmt::format("M{}", place) : std::string(kPointNames[point]);
}

class Compared : public ::testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }

  std::filesystem::path Written(const Result& result, const std::string& name = "result") {
    WriteResult(Path(name), result);
    return Path(name);
  }

  /// A swinging body's points as a laboratory records them from start_s to end_s.
  std::filesystem::path Recorded(const Laboratory& laboratory, double end_s) {
    const BodyModel body = GrownBody();
    std::mt19937 random(3);
    const std::vector<std::size_t> order = OrderOf(laboratory);
    std::string text = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tUnits\n100\tmm\nFrame#\tTime";
    for (std::size_t i = 0; i < order.size(); ++i)
      text += '\t' + NameIn(laboratory, i, order[i]) + "\t\t";
    text += "\n\tX1\n";
    for (int f = 0; laboratory.start_s + f / laboratory.rate_hz < end_s; ++f) {
      const double time_s = laboratory.start_s + f / laboratory.rate_hz;
      const BodyPoints points = body.PointsAt(body.PostureAt(testing::Swinging(body, time_s)));
      text += fmt::format("{}\t{:.6f}", f + 1, f / laboratory.rate_hz);
      for (const std::size_t i : order) {
        const Vector3 p = laboratory.X_LW * points.col(static_cast<int>(i));
        for (const double mm : p)
          text += fmt::format("\t{:.4f}", mm + laboratory.noise_mm * NoiseOf(random));
      }
      text += '\n';
    }
    testing::WriteText(Path("a.trc"), text);
    return Path("a.trc");
  }

  std::filesystem::path MapOf(const Laboratory& laboratory, bool theirs_first) {
    std::string text = "[points]\n";
    const std::vector<std::size_t> order = OrderOf(laboratory);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::string own(kPointNames[order[i]]), other = NameIn(laboratory, i, order[i]);
      text += theirs_first ? fmt::format("{} = \"{}\"\n", other, own)
                           : fmt::format("{} = \"{}\"\n", own, other);
    }
    testing::WriteText(Path("map.toml"), text);
    return Path("map.toml");
  }

  testing::TemporaryFolder folder_;
};

/// The goal of a comparison with a laboratory.
void ExpectFound(const Comparison& comparison, const Laboratory& laboratory) {
  const RigidTransform& X = comparison.alignment.X;
  EXPECT_NEAR(comparison.alignment.offset_s, laboratory.start_s, 0.002);
  const double turn = LogRotation(X.R * laboratory.X_LW.R).norm() * kDegreesPerRad;
  EXPECT_LT(turn, 0.1);
  const Vector3 there(2000, 500, 1200);
  EXPECT_LT((X * (laboratory.X_LW * there) - there).norm(), 1);
  EXPECT_EQ(comparison.points.size(), static_cast<std::size_t>(kPointCount));
  const std::vector<std::size_t> order = OrderOf(laboratory);
  for (const PointComparison& point : comparison.points) {
    const auto own = std::ranges::find(kPointNames, point.point) - kPointNames.begin();
    const auto place = std::ranges::find(order, static_cast<std::size_t>(own)) - order.begin();
    EXPECT_EQ(OthersOf(point),
              NameIn(laboratory, static_cast<std::size_t>(place), static_cast<std::size_t>(own)));
  }
  EXPECT_NEAR(comparison.points_rmsd_mm, laboratory.noise_mm * std::sqrt(3.0),
              0.4 * laboratory.noise_mm);
}

TEST_F(Compared, EveryExportOfAResultEqualsIt) {
  const auto result = Written(SwingingResult(60));
  const Result read = ReadResult(result);
  const ExportSubject subject{"", read};
  for (const ExportFormat& format : ExportFormats()) {
    if (format.name == "glb") continue;
    const auto file = Path("walk." + std::string(format.name));
    std::ofstream out(file, std::ios::binary);
    format.write({std::span(&subject, 1), read.poses, "walk"}, out);
    out.close();
    const Comparison comparison = Compare({.result = result, .other = file});
    EXPECT_NEAR(comparison.alignment.offset_s, 0, 1e-5) << format.name;
    EXPECT_LT(comparison.points_rmsd_mm, 0.05) << format.name;
    EXPECT_LT(comparison.angles_rmsd_deg, 0.01) << format.name;
    EXPECT_GT(comparison.angles.size(), 5u) << format.name;
    EXPECT_EQ(comparison.time_s.size(), 60u) << format.name;
  }
}

TEST_F(Compared, AResultEqualsItself) {
  const auto result = Written(SwingingResult(60));
  const Comparison comparison = Compare({.result = result, .other = result});
  EXPECT_NEAR(comparison.alignment.offset_s, 0, 1e-6);
  EXPECT_LT(comparison.points_rmsd_mm, 1e-6);
  EXPECT_LT(comparison.angles_rmsd_deg, 1e-6);
  EXPECT_EQ(comparison.points.size(), 38u);
}

TEST_F(Compared, AnotherLaboratoryIsFoundByAMapInEitherDirection) {
  const auto result = Written(SwingingResult(150)), other = Recorded(kElsewhere, 5.5);
  for (const bool theirs_first : {false, true}) {
    const Comparison comparison =
        Compare({.result = result, .other = other, .map = MapOf(kElsewhere, theirs_first)});
    EXPECT_EQ(comparison.alignment.by, PairedBy::kNames);
    ExpectFound(comparison, kElsewhere);
  }
}

TEST_F(Compared, AnotherLaboratoryIsFoundByMotionAlone) {
  const auto result = Written(SwingingResult(150)), other = Recorded(kElsewhere, 5.5);
  const Comparison comparison = Compare({.result = result, .other = other});
  EXPECT_EQ(comparison.alignment.by, PairedBy::kMotion);
  ExpectFound(comparison, kElsewhere);
}

TEST_F(Compared, ALaboratoryMayBeSlowerAndStartEarlier) {
  Result late = SwingingResult(150);
  late.poses.erase(late.poses.begin(), late.poses.begin() + 40);
  Laboratory slow = kElsewhere;
  slow.start_s = 0.3;
  slow.rate_hz = 12;
  slow.renames = false;
  const Comparison comparison = Compare({.result = Written(late), .other = Recorded(slow, 5.5)});
  // The result's time begins with its own first frame.
  EXPECT_NEAR(comparison.alignment.offset_s, 0.3 - 1.6, 0.002);
}

TEST_F(Compared, NoiseDoesNotPullTheOffsetBetweenFrames) {
  // At equal rates, interpolation smooths noise most halfway between frames.
  Laboratory noisy{{}, 1.0, 25, 20, false};
  const Comparison comparison =
      Compare({.result = Written(SwingingResult(150)), .other = Recorded(noisy, 5.5)});
  EXPECT_NEAR(comparison.alignment.offset_s, 1.0, 0.001);
}

TEST_F(Compared, AMarkerOnTheSkinIsBiasInItsSegmentsAxes) {
  const Result result = SwingingResult(80);
  const ResultMotion own = MotionOf(result);
  RecordedMotion other = own.motion;
  other.angles.clear();
  // 40 mm ahead of the left knee, on a thigh that turns in all directions.
  PointTrack& knee = *std::ranges::find(other.points, std::string("knee_l"), &PointTrack::name);
  for (std::size_t i = 0; i < knee.p_mm.size(); ++i)
    knee.p_mm[i] += own.R_WS[i][static_cast<std::size_t>(Segment::kThighL)] * Vector3(40, 0, 0);
  const auto alignment = AlignByNames(own, other, PairsByName(other));
  ASSERT_TRUE(alignment);
  Comparison comparison;
  comparison.alignment = *alignment;
  Measure(own, other, {}, comparison);
  const auto point =
      std::ranges::find(comparison.points, std::string("knee_l"), &PointComparison::point);
  EXPECT_NEAR(point->axes[0].bias, -40, 0.5);
  EXPECT_NEAR(point->axes[1].bias, 0, 0.5);
  EXPECT_NEAR(point->distance.rmsd, 40, 0.5);
  EXPECT_LT(point->rmsd_without_bias, 0.5);
}

TEST_F(Compared, WhoFitsBestIsChosenOrNamed) {
  Result walker = testing::WalkingResult(100);
  std::filesystem::create_directory(Path("people"));
  WritePeople(Path("people"), {{1, walker}, {2, SwingingResult(100)}});
  const auto other = Recorded({.renames = false}, 3.9);
  EXPECT_EQ(Compare({.result = Path("people"), .other = other}).person, "person-2");
  EXPECT_EQ(Compare({.result = Path("people"), .other = other, .person = "person-1"}).person,
            "person-1");
  EXPECT_THAT(SetupErrorOf([&] {
                Compare({.result = Path("people"), .other = other, .person = "person-7"});
              }),
              HasSubstr("has no tracked person-7"));
  EXPECT_EQ(Compare({.result = Path("people") / "person-1", .other = Path("people")}).subject,
            "person-1");
}

TEST_F(Compared, RecordingsThatHardlyFitAreDoubted) {
  const auto result = Written(SwingingResult(150));
  const auto remarks = [&](const Laboratory& laboratory, double end_s) {
    return Compare({.result = result, .other = Recorded(laboratory, end_s)}).remarks;
  };
  EXPECT_THAT(remarks({.start_s = 1, .noise_mm = 3}, 5.5), IsEmpty());
  EXPECT_THAT(remarks({.noise_mm = 40}, 5.5), ElementsAre(HasSubstr("even without bias")));
  // The result ends after 6 s.
  EXPECT_THAT(remarks({.start_s = 4.4, .noise_mm = 3}, 9),
              ElementsAre(HasSubstr("the offset may be wrong")));
}

TEST_F(Compared, WrongInputIsTold) {
  const auto result = Written(SwingingResult(30));
  const auto error = [&](const ComparisonRequest& request) {
    return SetupErrorOf([&] { Compare(request); });
  };
  EXPECT_THAT(error({.result = result, .other = Path("none.c3d")}), HasSubstr("not found"));
  for (const char* name : {"a.glb", "model.osim", "notes"}) {
    testing::WriteText(Path(name), "text");
    EXPECT_THAT(error({.result = result, .other = Path(name)}), HasSubstr("cannot be compared"));
  }
  const auto other = Recorded({.renames = false}, 1);
  EXPECT_THAT(error({.result = result, .other = other, .subject = "b"}),
              HasSubstr("has no subject \"b\""));
  testing::WriteText(Path("ages.csv"),
                     "time_s,head_x_mm,head_y_mm,head_z_mm\n0,1,2,3\n0.1,1,2,3\n1e12,1,2,3\n");
  EXPECT_THAT(error({.result = result, .other = Path("ages.csv")}), HasSubstr("at most a day"));
  const auto map_error = [&](const std::string& text) {
    testing::WriteText(Path("map.toml"), text);
    return error({.result = result, .other = other, .map = Path("map.toml")});
  };
  EXPECT_THAT(map_error("[points]\nM1 = \"M2\"\n"), HasSubstr("names no point of ours"));
  EXPECT_THAT(map_error("[points]\nheel_l = \"M2\"\n"), HasSubstr("names the marker \"M2\""));
  EXPECT_THAT(map_error("[points]\nhead = \"neck\"\nHEAD = \"torso\"\n"),
              HasSubstr("a second time"));
  EXPECT_THAT(map_error("[names]\nhead = \"neck\"\n"), HasSubstr("is no table of a map"));
  EXPECT_THAT(map_error("[angles]\na = \"b\"\n"), HasSubstr("is no angle of ours"));
}

TEST_F(Compared, AKneeOfAnOldModelIsTurned) {
  const auto result = Written(SwingingResult(60));
  const Result read = ReadResult(result);
  std::string text = "first trial\nendheader\ntime\tknee_angle_l\thip_flexion_l\n";
  const ResultMotion own = MotionOf(read);
  for (std::size_t i = 0; i < own.motion.time_s.size(); ++i)
    text += fmt::format("{}\t{}\t{}\n", own.motion.time_s[i],
                        -own.motion.FindAngle("knee_angle_l")->deg[i],
                        own.motion.FindAngle("hip_flexion_l")->deg[i]);
  testing::WriteText(Path("a.mot"), text);
  const Comparison comparison = Compare({.result = result, .other = Path("a.mot")});
  EXPECT_EQ(comparison.angles.size(), 2u);
  EXPECT_LT(comparison.angles_rmsd_deg, 0.01);
  EXPECT_TRUE(std::isnan(comparison.points_rmsd_mm));
}

TEST_F(Compared, TextJsonAndPageHaveTheSameFigures) {
  const auto result = Written(SwingingResult(100));
  const Comparison comparison =
      Compare({.result = result, .other = Recorded({.noise_mm = 3}, 3.9)});
  const Json json = ComparisonJson(comparison);
  EXPECT_NEAR(json["offset_s"].get<double>(), comparison.alignment.offset_s, 1e-6);
  EXPECT_NEAR(json["points_rmsd_mm"].get<double>(), comparison.points_rmsd_mm, 1e-3);
  EXPECT_TRUE(json["angles_by_points"].get<bool>());
  EXPECT_EQ(json["points"].size(), comparison.points.size());
  const std::string text = ComparisonText(comparison);
  EXPECT_THAT(text, HasSubstr(fmt::format("RMSD {:.1f} mm", comparison.points_rmsd_mm)));
  EXPECT_THAT(text, HasSubstr("bend of knee_l"));
  const auto data = testing::ReportData(ComparisonReportHtml("a", comparison));
  int folded = 0, tables = 0, figures = 0;
  for (const auto& section : data["sections"]) {
    folded += section["type"] == "details";
    tables += section["type"] == "table";
    figures += section["type"] == "figure";
  }
  EXPECT_EQ(folded, static_cast<int>(comparison.points.size()));
  EXPECT_EQ(figures, static_cast<int>(1 + comparison.angles.size()));
  EXPECT_EQ(tables, 2);
}

}  // namespace
}  // namespace mocap

// Simulated people of all builds, hair, clothes and loads: who is found, and how well tracked.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tools/accuracy/accuracy_benchmark.h"
#include "tools/accuracy/first_sets.h"

namespace mocap {

/// How the same people are filmed.
struct Filming {
  std::string label;
  double fps = 30;
  int cameras = 6;
  double covered_share = 0;  ///< As in AccuracyTrial.
};

/// 30 and 10 Hz, four and eight cameras, imperfect masks.
std::vector<Filming> Filmings();

/// Tracking of one varied person. With several first sets, errors are means over the runs, in the
/// sets that they have in common; everything else is that of the worst run.
struct VarietyRow {
  AccuracyRow accuracy;
  std::string looks;    ///< What the person wears.
  double found_s = -1;  ///< Until tracked for the first time; -1: never.
  double lost_s = 0;    ///< Longest time without tracking afterwards.
  PersonScore score = {};
};

/// The same people, filmed in one way.
struct VarietyGrid {
  Filming filming;
  std::vector<VarietyRow> rows;
};

/// Returns a person's take. The number determines motion, stature, build, costume and room.
AccuracyTrial VarietyTrialOf(int number, double seconds, const Filming& filming);
/// Tracks one person.
/// @param firsts  number of runs; the k-th begins with set k.
/// @throws SetupError  when that many seconds have fewer sets.
VarietyRow RunVarietyTrial(int number, double seconds, const Filming& filming, int firsts = 1);

/// Of hands, feet and head, in each person's first run.
ExtremityAccuracy MeanExtremities(const VarietyGrid& grid);

/// Header of VarietyLine's columns.
std::string VarietyHeader();
std::string VarietyLine(const VarietyRow& row);
/// Never found, found late, lost, wrong; mean and worst error. @param rows  at least one.
std::string VarietySummaryText(std::span<const VarietyRow> rows);
/// A table of all grids, and one of the ten worst people of each; nothing without grids.
std::string VarietyMarkdown(std::span<const VarietyGrid> grids);

}  // namespace mocap

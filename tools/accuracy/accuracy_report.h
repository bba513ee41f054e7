// The accuracy benchmark as text, as a table for people to read and as a plot.
#pragma once

#include <span>
#include <string>

#include "tools/accuracy/accuracy_benchmark.h"

namespace mocap {

/// The line above AccuracyLine's columns.
std::string AccuracyHeader();
std::string AccuracyLine(const AccuracyRow& row);
std::string AccuracySummaryText(const AccuracySummary& summary);

/// The same of takes of several people.
std::string PeopleHeader();
std::string PeopleLine(const PeopleRow& row);
/// Means and extremes. @param rows  at least one.
std::string PeopleSummaryText(std::span<const PeopleRow> rows);

/// A page with all tables; shows accuracy.svg beside it when there were sweeps.
std::string AccuracyMarkdown(const AccuracyBenchmark& benchmark);

/// How errors grow along each sweep. The result is an SVG file.
std::string AccuracySweepsSvg(std::span<const AccuracySweep> sweeps);

}  // namespace mocap

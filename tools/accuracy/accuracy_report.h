// The accuracy benchmark as text, as a Markdown table and as a plot.
#pragma once

#include <span>
#include <string>

#include "tools/accuracy/accuracy_benchmark.h"

namespace mocap {

/// Header of AccuracyLine's columns.
std::string AccuracyHeader();
std::string AccuracyLine(const AccuracyRow& row);
std::string AccuracySummaryText(const AccuracySummary& summary);

/// A Markdown table with a line for each step.
std::string SweepTable(const AccuracySweep& sweep);

/// Header and lines for takes of several people.
std::string PeopleHeader();
std::string PeopleLine(const PeopleRow& row);
/// Means and extremes. @param rows  at least one.
std::string PeopleSummaryText(std::span<const PeopleRow> rows);

/// A page with all tables. If there were sweeps, it links to accuracy.html, which lies beside it.
std::string AccuracyMarkdown(const AccuracyBenchmark& benchmark);

/// Plots the errors along each sweep, as a page.
std::string AccuracySweepsHtml(std::span<const AccuracySweep> sweeps);

}  // namespace mocap

// The paper's tracker with truth in place of some stages, as text and as Markdown tables.
#pragma once

#include <span>
#include <string>

#include "tools/accuracy/paper_trial.h"

namespace mocap {

/// Header of PaperLine's columns.
std::string PaperHeader();
/// The mean errors of one take.
std::string PaperLine(const PaperRow& row);

/// One Markdown table by what is replaced by truth, and one by motion with nothing replaced;
/// nothing without rows. Means over the takes that were acquired; shares of tracked frames over all
/// takes.
std::string PaperTables(std::span<const PaperRow> rows);
/// The same as a chapter of a page.
std::string PaperMarkdown(std::span<const PaperRow> rows, double seconds);

}  // namespace mocap

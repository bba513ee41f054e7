// Makes the daemon's parts from a configuration and an opened studio.
#pragma once

#include <deque>
#include <filesystem>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/body/body_table.h"
#include "daemon/messages/truth_error.h"
#include "daemon/pipeline/pipeline.h"
#include "daemon/recording/recording.h"
#include "daemon/service/background_learner.h"
#include "daemon/status/service_report.h"
#include "drivers/studio.h"

namespace mocap {

/// The parts of the daemon that exist before the first camera starts.
struct PreparedService {
  BodyTable body;
  std::unique_ptr<lcm::LCM> lcm;
  std::unique_ptr<lcm::LCM> preview_lcm;  ///< Null: previews use `lcm`.
  Studio studio;
};

/// Checks where the control socket will be. @return empty: there is none. @throws SetupError
std::filesystem::path ControlPlaceOf(const Config& config);

/// Opens and checks everything that a configuration names, except whether cameras answer. Every
/// start uses this. @throws SetupError
PreparedService PrepareService(const Config& config);

/// Checks whether RunService could start, including whether cameras answer. Rejects what RunService
/// rejects, with the same messages. Creates no file and no socket, and sends nothing.
/// @return  the remarks that a start would log.
/// @throws SetupError
std::vector<std::string> CheckConfig(const Config& config);

/// Checks whether files can be written where the configuration wants them, and whether the programs
/// that control nodes exist. @throws SetupError
void RequirePlaces(const Config& config);

PipelineOptions PipelineOptionsFor(const Config& config, std::vector<std::deque<FrameTap>*> taps);

KnownBackgrounds KnownBackgroundsOf(const Studio& studio);

/// Collects what a recording needs before the cameras go to the pipeline.
/// @param known  borrowed for the recordings' lives.
RecordedStudio RecordedStudioOf(const Studio& studio, const KnownBackgrounds& known,
                                const std::string& config_text);

/// Where the background is learned on request, and whether this is possible.
LearningPlace LearningPlaceFor(const Config& config, const Studio& studio);

/// The constant part of a report.
ServiceReport ReportAbout(const Config& config, const Studio& studio);

/// Age and origin of the background, as far as known.
Made BackgroundOf(const Config& config);

/// Compares with the truth if the person is simulated.
TruthError TruthFor(const SourceConfig& source);

}  // namespace mocap

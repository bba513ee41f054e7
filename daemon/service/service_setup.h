// From a configuration and an opened studio to what the daemon's parts are made of.
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

/// The parts of the daemon that exist before its first camera is started.
struct PreparedService {
  BodyTable body;
  std::unique_ptr<lcm::LCM> lcm;
  std::unique_ptr<lcm::LCM> preview_lcm;  ///< Empty: previews go the way of all else.
  Studio studio;
  std::filesystem::path socket;  ///< Empty: it is not controlled.
};

/// Opens and looks at all that a configuration names, cameras that answer excepted: the one way to
/// a start. @throws SetupError
PreparedService PrepareService(const Config& config);

/// Looks whether RunService could begin, with cameras that answer: what it refuses is refused here,
/// with the same words. Makes no file and no socket, and sends nothing. @throws SetupError
void CheckConfig(const Config& config);

/// Looks whether files can be written where the configuration wants them. @throws SetupError
void RequirePlaces(const Config& config);

PipelineOptions PipelineOptionsFor(const Config& config, std::vector<std::deque<FrameTap>*> taps);

KnownBackgrounds KnownBackgroundsOf(const Studio& studio);

/// What a recording needs to know before the cameras are handed to the pipeline.
/// @param known  borrowed for the recordings' lives.
RecordedStudio RecordedStudioOf(const Studio& studio, const KnownBackgrounds& known,
                                const std::string& config_text);

/// Where the empty studio is learned on command, and whether it can be.
LearningPlace LearningPlaceFor(const Config& config, const Studio& studio);

/// What a report says from the beginning to the end.
ServiceReport ReportAbout(const Config& config, const Studio& studio);

/// When the pictures of the empty studio were made, as far as that is known.
Made BackgroundOf(const Config& config);

/// The truth is known where the person is simulated.
TruthError TruthFor(const SourceConfig& source);

}  // namespace mocap

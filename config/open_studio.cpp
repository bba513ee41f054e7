#include "config/open_studio.h"

#include "core/errors.h"

namespace mocap {

Studio OpenStudio(const Config& config) {
  const SourceConfig& source = config.source;
  if (source.driver == "take") {
    return OpenTake(source.take, {.rate = source.rate, .loop = source.loop, .cameras = {}});
  }
  throw SetupError("source.driver is \"" + source.driver +
                   "\", which this build lacks; \"take\" is wanted");
}

}  // namespace mocap

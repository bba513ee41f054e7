#include "config/load_service_config.h"

namespace mocap {
namespace {

// The capacity of the kernel's cpu_set_t.
constexpr int kHighestProcessor = 1023;
// A socket's path must fit into a sockaddr_un.
constexpr std::size_t kLongestSocket = 100;
// The kernel's own threads are above this.
constexpr int kHighestPriority = 49;

RecordingConfig ReadRecording(TomlSection section, const std::filesystem::path& file) {
  RecordingConfig recording;
  recording.folder = Resolved(file, section.Text("folder", ""));
  recording.codec = static_cast<VideoCodec>(section.Choice("codec", {"huffyuv", "ffv1", "raw"}, 0));
  recording.buffer_mb = section.NumberWithin("buffer_mb", 16, 65536, recording.buffer_mb);
  recording.keep_free_mb = section.NumberWithin("keep_free_mb", 0, 1e6, recording.keep_free_mb);
  section.RejectUnknownKeys();
  return recording;
}

}  // namespace

ServiceConfig ReadServiceConfig(TomlSection& root, const std::filesystem::path& file) {
  ServiceConfig config;
  if (auto section = root.Section("control")) {
    config.control.socket = Resolved(file, section->Text("socket", ""));
    if (config.control.socket.native().size() > kLongestSocket) {
      section->Fail("socket", "is longer than " + std::to_string(kLongestSocket) + " characters");
    }
    section->RejectUnknownKeys();
  }
  if (auto section = root.Section("recording")) {
    config.recording = ReadRecording(*section, file);
  }
  if (auto section = root.Section("metrics")) {
    config.metrics.file = Resolved(file, section->Text("file", ""));
    if (!config.metrics.file.empty() && config.metrics.file.extension() != ".prom") {
      section->Fail("file", "is \"" + config.metrics.file.string() +
                                "\"; node exporter reads only files whose names end in .prom");
    }
    section->RejectUnknownKeys();
  }
  if (auto section = root.Section("realtime")) {
    if (section->Has("priority")) {
      config.realtime.priority =
          static_cast<int>(section->IntegerWithin("priority", 0, kHighestPriority, 0));
    }
    config.realtime.lock_memory = section->Flag("lock_memory", false);
    config.realtime.processors = section->Integers("processors", 0, kHighestProcessor);
    section->RejectUnknownKeys();
  }
  return config;
}

}  // namespace mocap

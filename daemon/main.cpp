// mocapd: from cameras to poses on LCM.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "config/load_config.h"
#include "daemon/base/number_option.h"
#include "daemon/run_program.h"
#include "daemon/service/service.h"
#include "daemon/service/service_setup.h"
#include "daemon/service/stop_signals.h"
#include "drivers/printable_text.h"

int main(int argc, char** argv) {
  CLI::App app("Markerless motion capture in real time, published on LCM", "mocapd");
  std::optional<std::filesystem::path> file;
  bool only_checks = false;
  std::optional<double> seconds;
  app.add_option("--config", file,
                 "mocapd configuration file in TOML (default: a simulated studio)");
  app.add_flag("--check-config", only_checks, "check the configuration and exit");
  app.add_option("--seconds", seconds, "stop after this many seconds")
      ->check(mocap::NumberFrom(0.001, 1e8));
  app.set_version_flag("--version", MOCAP_VERSION);
  app.callback([&] {
    if (only_checks) {
      for (const std::string& remark :
           mocap::CheckConfig(file ? mocap::LoadConfig(*file) : mocap::Config())) {
        std::fprintf(stderr, "mocapd: warning: %s\n", mocap::Printable(remark).c_str());
      }
      std::puts("the configuration is valid");
    } else {
      mocap::HoldSignals();
      mocap::RunService(file, seconds);
    }
  });
  return mocap::RunProgram(app, argc, argv);
}

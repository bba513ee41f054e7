#include "tools/view.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/load_config.h"
#include "core/errors.h"
#include "daemon/base/json.h"
#include "daemon/base/number_option.h"
#include "daemon/messages/open_lcm.h"
#include "drivers/printable_text.h"
#include "drivers/take/input_file.h"
#include "tools/chosen_config.h"
#include "tools/page/page_files.h"
#include "tools/remarks.h"
#include "tools/view/access.h"
#include "tools/view/control_desk.h"
#include "tools/view/live_feed.h"
#include "tools/view/take_site.h"
#include "tools/view/view_server.h"

namespace mocap {
namespace {

constexpr std::uint16_t kPort = 8077;
constexpr std::size_t kLargestScript = 16 << 20;
constexpr std::chrono::milliseconds kEndTick{250};

struct ViewOptions {
  std::filesystem::path take;
  std::vector<std::filesystem::path> results;
  std::filesystem::path config;
  std::filesystem::path socket;
  std::optional<std::string> url;
  std::optional<std::string> prefix;
  int port = kPort;
};

std::string TypeOf(const std::string& name) {
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/html; charset=utf-8";
}

std::string Script(const std::filesystem::path& file) {
  if (!IsThere(file)) {
    throw SetupError(file.string() + ": not found; install Debian's package libjs-three");
  }
  return ReadWholeFile(file, "three.js", kLargestScript);
}

std::map<std::string, PageFile> PageFiles() {
  std::map<std::string, PageFile> files;
  for (const BuiltinPageFile& file : BuiltinPageFiles()) {
    const std::string name(file.name);
    files['/' + name] = {TypeOf(name), std::string(file.text)};
  }
  files["/"] = files["/index.html"];
  files["/three.js"] = {TypeOf("three.js"), Script(MOCAP_THREE_JS)};
  return files;
}

void AddAbout(const std::string& mode, const std::string& title,
              std::map<std::string, PageFile>& files) {
  files["/view.json"] = {"application/json",
                         JsonText({{"mode", mode}, {"version", MOCAP_VERSION}, {"title", title}})};
}

void Announce(const ViewServer& server, const std::string& token) {
  std::string address = "http://127.0.0.1:" + std::to_string(server.port()) + "/";
  if (!token.empty()) address += "#token=" + token;
  std::printf("the view is at %s\nCtrl-C ends it\n", address.c_str());
  std::fflush(stdout);
}

void ViewTake(const ViewOptions& options) {
  TakeSite site(options.take, options.results, options.prefix);
  TellRemarks("view", site.remarks());
  std::map<std::string, PageFile> files = PageFiles();
  AddAbout("replay", site.name(), files);
  ViewServer server({.port = static_cast<std::uint16_t>(options.port),
                     .files = std::move(files),
                     .answer = [&site](const ViewRequest& request) { return site.Answer(request); },
                     .is_live = false});
  Announce(server, "");
  server.Run();
}

void ViewLive(const ViewOptions& options) {
  const Config config = LoadChosenConfig(options.config);
  const std::string url = options.url.value_or(config.lcm.url);
  if (url.starts_with("file:"))
    throw SetupError("--url: " + url + " is a log; to view it: mocap view TAKE LOG");
  const std::string token = MakeToken();
  ControlDesk desk(options.socket.empty() ? config.service.control.socket : options.socket, token);
  const std::unique_ptr<lcm::LCM> lcm = OpenLcmToListen(url);
  std::map<std::string, PageFile> files = PageFiles();
  AddAbout("live", "mocapd", files);
  ViewServer server({.port = static_cast<std::uint16_t>(options.port),
                     .files = std::move(files),
                     .answer = [&desk](const ViewRequest& request) { return desk.Answer(request); },
                     .is_live = true});
  LiveFeed feed(
      *lcm, options.prefix.value_or(config.lcm.prefix), url,
      [&server](std::size_t slot, LiveMessage message) { server.Put(slot, std::move(message)); });
  server.OnReadable(lcm->getFileno(), [&lcm] { lcm->handleTimeout(0); });
  server.Every(kEndTick, [&feed] { feed.Tick(); });
  server.Every(ControlDesk::kLookPeriod, [&] {
    if (server.live_pages() == 0) return;
    const auto why = std::make_shared<std::string>();
    server.Aside([&desk, why] { *why = desk.Look(); }, [&feed, why] { feed.NoteControl(*why); });
  });
  Announce(server, token);
  server.Run();
}

void View(const ViewOptions& options) {
  options.take.empty() ? ViewLive(options) : ViewTake(options);
}

}  // namespace

void AddViewCommand(CLI::App& app) {
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* command =
      app.add_subcommand("view", "Show the studio, or a take with its results, in a browser");
  command->add_option("TAKE", options->take, "take folder (default: the running mocapd)");
  command->add_option("RESULT", options->results,
                      "result folders of mocap track for the take, or LCM logs");
  command->add_option("--config", options->config,
                      "mocapd configuration file in TOML (default: the system's)");
  command->add_option("--socket", options->socket,
                      "mocapd control socket (default: from the configuration)");
  command->add_option("--url", options->url, "LCM URL (default: from the configuration)");
  command->add_option("--prefix", options->prefix,
                      "prefix of the LCM channel names, also in logs (default: from the "
                      "configuration)");
  command->add_option("--port", options->port, "TCP port on 127.0.0.1; 0: any free port")
      ->check(NumberFrom(0, 65535))
      ->capture_default_str();
  command->callback([options] { View(*options); });
}

}  // namespace mocap

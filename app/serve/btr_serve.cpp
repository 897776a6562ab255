// The open interface: other people's programs watch, drive and learn over the network.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/btr_commands.h"
#include "app/live/btr_camera_eye.h"
#include "app/serve/served_programs.h"
#include "core/remote/server.h"
#include "core/spec/error.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

struct ServeArguments {
  remote::Server::Options server;
  std::vector<std::string> tls;
  std::string games, database;
  int port = 50051, jobs = 0, worlds = 16;
  double idle_s = 600;
  bool noAddress = false;
};

/// What comes with the program: resources, or share/uchilsim of an installed program, in a folder above the executable.
std::string ownResources() {
  for (fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();; folder = folder.parent_path()) {
    for (const char* resources : {"share/uchilsim", "resources"})
      if (fs::exists(folder / resources / "scenes" / "kick.json")) return (folder / resources).string();
    if (folder == folder.parent_path())
      throw InputError("btr serve: no resources were found above the program; name a folder with --games");
  }
}

/// Connections that say nothing hold a descriptor each for a while: they shall not keep others out.
void allowManyConnections() {
  constexpr rlim_t enough = 65536;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= enough) return;
  limit.rlim_cur = std::min(limit.rlim_max, enough);
  setrlimit(RLIMIT_NOFILE, &limit);  // else as many as there may be
}

void serve(ServeArguments& a, Shell& shell) {
  allowManyConnections();
  const bool ownFolder = !a.games.empty();
  remote::Switchboard::Options options{remote::GamesFolder(ownFolder ? a.games : ownResources(), ownFolder)};
  if (!a.database.empty()) options.database = fs::absolute(a.database).lexically_normal().string();
  options.jobs = a.jobs;
  options.cameras = cameraMaker();
  options.programs = stickProgramsMaker();
  options.mostWorlds = a.worlds;
  options.idle_s = a.idle_s;
  if (a.tls.size() == 2) {
    a.server.certificate = a.tls[0];
    a.server.key = a.tls[1];
  }
  a.server.port = a.port;
  if (a.noAddress) a.server.address.clear();
  remote::Switchboard switchboard(options, shell.plugins());
  const remote::Server server(a.server, switchboard);
  if (shell.json)
    printJson({{"listens", server.where()},
               {"port", server.port()},
               {"unix", a.server.unixPath},
               {"tls", !a.server.certificate.empty()},
               {"tokens", !a.server.gate.tokenFile.empty()},
               {"games", options.folder.path()},
               {"logs", options.folder.writable()}});
  else
    std::cout << "listens on " << server.where() << (a.server.certificate.empty() ? "" : " with TLS")
              << (a.server.gate.tokenFile.empty() ? "" : ", for who has a token") << "; games of "
              << options.folder.path()
              << (options.folder.writable() ? ", logs in its folder sessions" : ", which is only read: no logs")
              << "\n";
  std::cout.flush();
  while (!*shell.stop && !server.isToEnd()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
}

}  // namespace

static void addServe(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<ServeArguments>();
  app.add_option("--port", a->port, "TCP port; 0: any that is free")
      ->transform(wholeNumber(0, 65535))
      ->capture_default_str();
  app.add_option("--address", a->server.address,
                 "address of this machine; another than 127.0.0.1 only with --tls and --token-file")
      ->capture_default_str();
  app.add_option("--unix", a->server.unixPath, "also a Unix socket, which only this user may open");
  app.add_flag("--only-unix", a->noAddress, "no TCP port");
  app.add_option("--tls", a->tls, "certificate and key, PEM files")->expected(2)->check(CLI::ExistingFile);
  app.add_option("--token-file", a->server.gate.tokenFile,
                 "who may do what: lines ROLE TOKEN [NAME] (watch, drive, administrate); mode 0600");
  app.add_option("--db", a->database, "experiment database: runs, learners outside, measured values");
  app.add_option("--games", a->games,
                 "the only folder whose files clients may name; sessions are logged in it (default: the program's own, "
                 "read only)");
  app.add_option("--jobs", a->jobs, "worker processes of an evaluation or a run (0: as many as processors)")
      ->transform(wholeNumber(0, 1024));
  app.add_option("--worlds", a->worlds, "how many may run at a time")
      ->transform(wholeNumber(1, 1024))
      ->capture_default_str();
  app.add_option("--idle", a->idle_s, "a world that nobody calls for so long is closed [s]")
      ->transform(decimalNumber(1, 1e6))
      ->capture_default_str();
  app.add_option("--rate", a->server.gate.callsPerSecond, "calls a second of one client")
      ->transform(decimalNumber(1, 1e6))
      ->capture_default_str();
  app.callback([a, &shell] { serve(*a, shell); });
}

}  // namespace btr::cli

int main(int argc, char** argv) {
  CLI::App app{"The open interface: other programs watch, drive and learn, over gRPC (uchilsim.proto)", "btr-serve"};
  btr::cli::Shell shell;
  btr::cli::beginCommands(app, shell);
  app.require_subcommand(0);
  btr::cli::addServe(app, shell);
  return btr::cli::runCommands(app, shell, argc, argv);
}

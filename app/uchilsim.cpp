// The workbench: a window on the runs of one database.
#include <CLI/CLI.hpp>
#include <QApplication>
#include <QFileInfo>
#include <QIcon>
#include <QTimer>
#include <cstdio>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "core/spec/number_options.h"
#include "core/spec/system/process.h"
#include "ui/common/numbers/plain_numbers.h"
#include "ui/controllers/grid_controller.h"
#include "ui/controllers/replay_controller.h"
#include "ui/main_window.h"

namespace {

struct Arguments {
  std::string database, screenshot, look, report, scene;
  btr::Id run = 0, grid = 0;
  bool replayBest = false;
  int width = 1600, height = 1000, delay_ms = 3000;
};

// The database that was named, else the one of last time, else experiments.db.
QString chooseDatabase(const Arguments& arguments, const btr::ui::Settings& settings) {
  if (!arguments.database.empty()) return QString::fromStdString(arguments.database);
  const QStringList recent = settings.recentDatabases();
  return recent.isEmpty() ? QStringLiteral("experiments.db") : recent.first();
}

// Of a picture: no screen makes the window smaller, and none that was maximized larger; only what stands in it may.
void keepSize(QWidget& window, const QSize& size) {
  window.setWindowState(Qt::WindowNoState);
  window.setFixedSize(size.expandedTo(window.minimumSizeHint()));
}

// False if it cannot be written.
bool savePicture(QWidget& window, const Arguments& arguments) {
  if (window.width() != arguments.width || window.height() != arguments.height)
    std::fprintf(stderr, "%s: %d × %d instead of %d × %d: the window cannot have that size\n",
                 arguments.screenshot.c_str(), window.width(), window.height(), arguments.width, arguments.height);
  if (window.grab().save(QString::fromStdString(arguments.screenshot))) return true;
  std::fprintf(stderr, "%s: cannot be written\n", arguments.screenshot.c_str());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  btr::beginProgram();
  Arguments arguments;
  CLI::App commandLine{"UCHILSIM, a workbench for Back to Reality", "uchilsim"};
  commandLine.add_option("DATABASE", arguments.database,
                         "experiment database (default: the last one, else experiments.db)");
  commandLine.add_option("--select-run", arguments.run, "number of the run to show")
      ->transform(btr::cli::wholeNumber(1));
  commandLine.add_flag("--replay-best", arguments.replayBest,
                       "replay the best individual of the run's last generation");
  commandLine.add_option("--report", arguments.report, "folder of a gap report to open");
  commandLine.add_option("--scene", arguments.scene,
                         "game, scene or robot file, or a session's log, to open on the scene page");
  commandLine.add_option("--grid", arguments.grid, "number of the grid to show")->transform(btr::cli::wholeNumber(1));
  commandLine.add_option("--look", arguments.look, "for this start")->check(CLI::IsMember({"system", "light", "dark"}));
  commandLine.add_option("--screenshot", arguments.screenshot, "write a picture of the window to this file and quit");
  commandLine.add_option("--width", arguments.width, "of the window in the picture, whatever the screen's")
      ->transform(btr::cli::wholeNumber(640, 8000));
  commandLine.add_option("--height", arguments.height, "of the window in the picture, whatever the screen's")
      ->transform(btr::cli::wholeNumber(480, 8000));
  commandLine.add_option("--delay-ms", arguments.delay_ms, "time to load before the picture is taken")
      ->transform(btr::cli::wholeNumber(0, 600000));
  commandLine.set_version_flag("--version", "uchilsim " + btr::programVersion());
  CLI11_PARSE(commandLine, argc, argv);

  QApplication application(argc, argv);
  btr::ui::usePlainNumbers();
  QApplication::setApplicationName("UCHILSIM");
  QApplication::setApplicationVersion(QString::fromStdString(btr::programVersion()));
  QApplication::setDesktopFileName("uchilsim");
  try {
    btr::ui::Theme theme(application);
    const auto host = std::make_shared<const btr::PluginHost>(btr::PluginHost::searchPath());
    btr::ui::MainWindow window(host, theme);
    const QString database = chooseDatabase(arguments, window.bench().settings());
    if (!arguments.screenshot.empty() && !QFileInfo::exists(database))
      throw btr::InputError(database.toStdString() + ": there is no such database; \"btr run EXPERIMENT --db " +
                            database.toStdString() + "\" makes one, and no name opens the last one");
    if (!arguments.look.empty()) theme.apply(btr::ui::lookFromText(QString::fromStdString(arguments.look)));
    if (!arguments.screenshot.empty()) keepSize(window, {arguments.width, arguments.height});
    window.show();
    // Only a name that the user has typed is asked about.
    if (!arguments.database.empty() || QFileInfo::exists(database)) window.openDatabase(database);
    const bool asked = arguments.run || arguments.grid || arguments.replayBest || !arguments.report.empty() ||
                       !arguments.scene.empty();
    if (!asked && arguments.screenshot.empty()) window.showStartIfIdle();
    if (arguments.run) window.selectRun(arguments.run);
    if (!arguments.report.empty()) window.openReport(QString::fromStdString(arguments.report));
    if (!arguments.scene.empty()) window.openScene(QString::fromStdString(arguments.scene));
    if (arguments.grid) window.grids().show(arguments.grid);
    if (arguments.replayBest) window.bench().whenSelected([&window] { window.replays().replayBest(); });

    if (!arguments.screenshot.empty())
      QTimer::singleShot(arguments.delay_ms, &window,
                         [&] { QApplication::exit(savePicture(window, arguments) ? 0 : 1); });
    return QApplication::exec();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

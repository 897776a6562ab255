#pragma once
// A page of a running world with a small game, for the tests of its widgets with the real program.
#include <QAction>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin_host.h"
#include "core/spec/json_reader.h"
#include "ui/live/live_page.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/object_tree.h"

namespace btr::ui {

inline const PluginHost& plugins() {
  static const PluginHost host(PLUGIN_DIR);
  return host;
}

/// A page with a small game: a walking dog, a ball, a crate.
struct OpenPage {
  QTemporaryDir folder;
  LivePage page{plugins(), BTR_PROGRAM, folder.path() + "/sessions"};
  QString file = folder.filePath("game.json");

  OpenPage() {
    nlohmann::json game = {
        {"format", "uchilsim-game-1"},
        {"scene",
         {{"format", "uchilsim-scene-1"},
          {"step_s", 0.008},
          {"control_period_s", 0.008},
          {"floor", {{"friction", 1}}},
          {"robots",
           {{{"name", "dog"}, {"model", SOURCE_DIR "/resources/robots/ers7.wrl"}, {"position_m", {-0.6, 0, 0}}}}},
          {"balls", {{{"name", "ball"}, {"position_m", {0.1, 0, 0.0425}}, {"rolling_deceleration_m_s2", 0.4}}}},
          {"obstacles", {{{"name", "crate"}, {"mass_kg", 0.2}, {"position_m", {0.1, 0.35, 0.05}}}}}}},
        {"robots", {{"dog", {{"team", "blue"}, {"controller", {{"plugin", "walk"}}}}}}}};
    writeFile(file.toStdString(), game.dump());
    page.resize(900, 600);  // without a graphics card most of the time goes into pixels
    page.show();
    page.open(file);
  }

  bool isThere() {
    return QTest::qWaitFor([this] { return !page.row().values.empty(); }, 20000);
  }
  QAction* action(const char* name) { return page.findChild<QAction*>(name); }
  ObjectTree* tree() { return page.findChild<ObjectTree*>(); }
  std::size_t count() { return page.world().objects().size(); }
  /// Of the page as it is, where somebody wants to look: a folder in $LIVE_PICTURES.
  void picture(const QString& name) {
    const QString wanted = qEnvironmentVariable("LIVE_PICTURES");
    if (!wanted.isEmpty()) page.grab().save(wanted + "/" + name + ".png");
  }
  /// By a click in the tree.
  void select(const std::string& object) { tree()->setCurrentItem(tree()->itemOf(object)); }
};

}  // namespace btr::ui

#include "ui/live/live_desk.h"

#include <QDockWidget>
#include <nlohmann/json.hpp>

#include "ui/live/drawn/extra_view.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/console_panel.h"
#include "ui/live/panels/eye_panel.h"
#include "ui/live/program_record.h"

namespace btr::ui {
namespace {

using nlohmann::json;

template <typename Content>
QList<Content*> contentsOf(const QMainWindow& desk) {
  QList<Content*> contents;
  for (QDockWidget* dock : desk.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (auto* content = qobject_cast<Content*>(dock->widget())) contents.append(content);
  return contents;
}

}  // namespace

LiveDesk::LiveDesk(LiveWorld& world, LiveView* view, QWidget* parent)
    : QMainWindow(parent, Qt::Widget), world_(world), view_(view), programs_(new ProgramRecord(world, this)) {
  setObjectName("liveDesk");
  setDockNestingEnabled(true);
  setContextMenuPolicy(Qt::NoContextMenu);
  setCentralWidget(view_);
  connect(view_, &LiveView::markToggled, this, &LiveDesk::askContacts);
  connect(programs_, &ProgramRecord::began, this, &LiveDesk::showConsole);
  connect(programs_, &ProgramRecord::ended, this,
          [this](const QString& robot, const QString& why) { emit problem(tr("%1: %2").arg(robot, why)); });
}

QDockWidget* LiveDesk::addDock(QWidget* content, const QString& title, Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName("dock" + QString::number(++counted_));
  dock->setAttribute(Qt::WA_DeleteOnClose);
  dock->setWidget(content);
  addDockWidget(area, dock);
  // So that the main view stays the largest.
  if (area == Qt::RightDockWidgetArea)
    resizeDocks({dock}, {width() / 3}, Qt::Horizontal);
  else
    resizeDocks({dock}, {height() * 2 / 5}, Qt::Vertical);
  return dock;
}

ExtraView* LiveDesk::addView() {
  auto* view = new ExtraView(world_);
  view->view().setCamera(view_->camera());
  connect(&view->view(), &LiveView::markToggled, this, &LiveDesk::askContacts);
  addDock(view, tr("View %1").arg(views().size() + 2), Qt::RightDockWidgetArea);
  return view;
}

EyePanel* LiveDesk::addEye() {
  auto* eye = new EyePanel(world_);
  connect(eye, &EyePanel::problem, this, &LiveDesk::problem);
  addDock(eye, tr("Camera %1").arg(eyes().size() + 1), Qt::BottomDockWidgetArea);
  return eye;
}

ConsolePanel* LiveDesk::showConsole() {
  if (const auto there = contentsOf<ConsolePanel>(*this); !there.isEmpty()) {
    there.first()->parentWidget()->raise();
    return there.first();
  }
  auto* console = new ConsolePanel(world_, *programs_);
  addDock(console, tr("Robots' programs"), Qt::BottomDockWidgetArea);
  return console;
}

QList<ExtraView*> LiveDesk::views() const { return contentsOf<ExtraView>(*this); }
QList<EyePanel*> LiveDesk::eyes() const { return contentsOf<EyePanel>(*this); }

/// They are told while any view draws them.
void LiveDesk::askContacts() {
  bool any = view_->markAction(Mark::contacts)->isChecked();
  for (ExtraView* view : views()) any |= view->view().markAction(Mark::contacts)->isChecked();
  world_.process().setContacts(any);
}

void LiveDesk::closeAll() {
  for (QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) delete dock;
  counted_ = 0;
}

std::string LiveDesk::state() const {
  json document{{"camera", toJson(view_->camera())}, {"keep_in_view", view_->keepsInView()}, {"docks", json::array()}};
  for (const QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
    if (const auto* view = qobject_cast<ExtraView*>(dock->widget()))
      document["docks"].push_back({{"view", view->state()}});
    if (const auto* eye = qobject_cast<EyePanel*>(dock->widget())) document["docks"].push_back({{"eye", eye->state()}});
    if (qobject_cast<ConsolePanel*>(dock->widget())) document["docks"].push_back({{"console", json::object()}});
  }
  document["layout"] = saveState().toBase64().toStdString();
  return document.dump();
}

void LiveDesk::restore(const std::string& state) {
  const json document = json::parse(state, nullptr, false);
  if (!document.is_object()) return;
  closeAll();
  if (document.contains("camera")) view_->setCamera(viewCameraFrom(document.at("camera")));
  if (const auto keep = document.find("keep_in_view"); keep != document.end() && keep->is_boolean())
    view_->setKeepingInView(keep->get<bool>());
  constexpr std::size_t mostDocks = 12;
  if (const auto docks = document.find("docks"); docks != document.end() && docks->is_array())
    for (const json& dock : *docks) {
      if (static_cast<std::size_t>(counted_) >= mostDocks || !dock.is_object()) continue;
      if (dock.contains("view")) addView()->restore(dock.at("view"));
      if (dock.contains("eye")) addEye()->restore(dock.at("eye"));
      if (dock.contains("console")) showConsole();
    }
  if (const auto layout = document.find("layout"); layout != document.end() && layout->is_string())
    restoreState(QByteArray::fromBase64(QByteArray::fromStdString(layout->get<std::string>())));
}

}  // namespace btr::ui

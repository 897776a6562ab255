#include "ui/window/dock_layout.h"

#include <QDockWidget>
#include <QEvent>
#include <QLayout>
#include <QMainWindow>
#include <limits>
#include <utility>

#include "ui/common/look/theme.h"
#include "ui/common/settings.h"
#include "ui/window/scroll_page.h"

namespace btr::ui {
namespace {
/// Below this the panes of a full layout would be too low to be read.
constexpr QSize roomy{1400, 820};
/// Below this three panes beside each other would be too narrow: a screen of 1280×720 whose scale is 2 has 640.
constexpr int narrow = 700;
}  // namespace

DockLayout::DockLayout(QMainWindow& window) : QObject(&window), window_(window) {
  window_.setDockNestingEnabled(true);
  window_.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
}

QDockWidget* DockLayout::add(const QString& name, const QString& title, const QString& icon, QWidget* content) {
  auto* dock = new QDockWidget(title, &window_);
  dock->setObjectName("dock." + name);
  dock->setWidget(new ScrollPage(content, dock));
  if (name == "run") content->installEventFilter(this);
  dock->setWindowIcon(themeIcon(icon));
  dock->toggleViewAction()->setIcon(themeIcon(icon));
  return dock;
}

QDockWidget* DockLayout::addPage(const QString& name, const QString& title, const QString& icon, QWidget* content,
                                 const QStringList& beside) {
  pages_[name] = beside;
  return add(name, title, icon, content);
}

QDockWidget* DockLayout::dock(const QString& name) const {
  return window_.findChild<QDockWidget*>("dock." + name, Qt::FindDirectChildrenOnly);
}

bool DockLayout::isPage(const QDockWidget* dock) const { return pages_.contains(dock->objectName().mid(5)); }

QList<QDockWidget*> DockLayout::all() const {
  return window_.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
}

bool DockLayout::isCompact() const { return window_.width() < roomy.width() || window_.height() < roomy.height(); }

bool DockLayout::isNarrow() const { return window_.width() < narrow; }

void DockLayout::arrange() {
  before_.clear();
  if (!std::exchange(page_, {}).isEmpty()) emit pageChanged({});
  for (QDockWidget* dock : all()) {
    window_.removeDockWidget(dock);
    dock->setFloating(false);
  }
  if (isNarrow())
    placeNarrow();
  else if (isCompact())
    placeCompact();
  else
    place();
  for (QDockWidget* dock : all()) dock->setVisible(!isPage(dock));
  dock("compare")->hide();
  dock("spec")->raise();
  dock(isCompact() ? "fitness" : "individuals")->raise();
  sized_ = false;
  if (window_.isVisible()) size();
}

// Left what there is, in the middle how it goes, right what is asked for.
void DockLayout::place() {
  window_.addDockWidget(Qt::LeftDockWidgetArea, dock("tree"));
  window_.splitDockWidget(dock("tree"), dock("run"), Qt::Horizontal);
  window_.splitDockWidget(dock("run"), dock("spec"), Qt::Horizontal);
  window_.splitDockWidget(dock("run"), dock("fitness"), Qt::Vertical);
  window_.splitDockWidget(dock("fitness"), dock("individuals"), Qt::Vertical);
  window_.splitDockWidget(dock("fitness"), dock("gap"), Qt::Horizontal);
  window_.splitDockWidget(dock("spec"), dock("replay"), Qt::Vertical);
  // Tabs come last: a dock that is split from a tab becomes one of the tabs.
  window_.tabifyDockWidget(dock("spec"), dock("draft"));
  window_.tabifyDockWidget(dock("individuals"), dock("sheet"));
  window_.tabifyDockWidget(dock("sheet"), dock("policies"));
  window_.tabifyDockWidget(dock("policies"), dock("simulators"));
  window_.tabifyDockWidget(dock("spec"), dock("compare"));
}

// On a small screen one pane of each kind is large enough, the others are tabs of it.
void DockLayout::placeCompact() {
  window_.addDockWidget(Qt::LeftDockWidgetArea, dock("tree"));
  window_.splitDockWidget(dock("tree"), dock("run"), Qt::Horizontal);
  window_.splitDockWidget(dock("run"), dock("spec"), Qt::Horizontal);
  window_.splitDockWidget(dock("run"), dock("fitness"), Qt::Vertical);
  const char* behind = "fitness";
  for (const char* name : {"gap", "individuals", "sheet", "policies", "simulators"})
    window_.tabifyDockWidget(dock(std::exchange(behind, name)), dock(name));
  window_.tabifyDockWidget(dock("spec"), dock("draft"));
  window_.tabifyDockWidget(dock("draft"), dock("replay"));
  window_.tabifyDockWidget(dock("replay"), dock("compare"));
}

// All panes but the tree are tabs of one.
void DockLayout::placeNarrow() {
  window_.addDockWidget(Qt::LeftDockWidgetArea, dock("tree"));
  window_.splitDockWidget(dock("tree"), dock("run"), Qt::Horizontal);
  const char* behind = "run";
  for (const char* name :
       {"fitness", "gap", "individuals", "sheet", "policies", "simulators", "spec", "draft", "replay", "compare"})
    window_.tabifyDockWidget(dock(std::exchange(behind, name)), dock(name));
}

void DockLayout::size() {
  sized_ = true;
  const int width = window_.width(), height = window_.height();
  if (isNarrow() && window_.tabifiedDockWidgets(dock("run")).contains(dock("spec"))) {
    const int tree = width * 25 / 100;
    return window_.resizeDocks({dock("tree"), dock("run")}, {tree, width - tree}, Qt::Horizontal);
  }
  const int left = isCompact() ? width * 16 / 100 : width * 19 / 100;
  const int right = isCompact() ? width * 27 / 100 : width * 29 / 100, middle = width - left - right;
  window_.resizeDocks({dock("tree"), dock("run"), dock("spec")}, {left, middle, right}, Qt::Horizontal);
  const int top = runHeight(middle), rest = height - top - 90;
  runHeight_ = 0;
  QMetaObject::invokeMethod(this, &DockLayout::growRun, Qt::QueuedConnection);
  if (isCompact()) {
    window_.resizeDocks({dock("run"), dock("fitness")}, {top, rest}, Qt::Vertical);
    return;
  }
  window_.resizeDocks({dock("run"), dock("fitness"), dock("individuals")}, {top, rest * 54 / 100, rest * 46 / 100},
                      Qt::Vertical);
  window_.resizeDocks({dock("spec"), dock("replay")}, {(top + rest) * 50 / 100, (top + rest) * 50 / 100}, Qt::Vertical);
  // Sizes as they shall be: what both ask for together is what the middle gets.
  window_.resizeDocks({dock("fitness"), dock("gap")}, {middle * 54 / 100, middle * 46 / 100}, Qt::Horizontal);
}

/// As high as the run's text needs at that width, without a scroll bar, and the title of the dock.
int DockLayout::runHeight(int width) const {
  const QWidget* text = qobject_cast<const ScrollPage*>(dock("run")->widget())->widget();
  const int least = qMax(text->layout()->minimumHeightForWidth(width), text->minimumSizeHint().height());
  return least + window_.fontMetrics().height() * 2;
}

// The first layout is made before a run has been read, and some runs have more to say than others. What the user made
// lower stays so until there is more to say than ever before.
bool DockLayout::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::LayoutRequest)
    QMetaObject::invokeMethod(this, &DockLayout::growRun, Qt::QueuedConnection);
  return QObject::eventFilter(watched, event);
}

void DockLayout::keepRunInSight() {
  const QDockWidget* run = dock("run");
  if (!run->isVisible() || run->height() < runHeight(run->width())) return;
  runHeight_ = 0;
  QMetaObject::invokeMethod(this, &DockLayout::growRun, Qt::QueuedConnection);
}

void DockLayout::growRun() {
  QDockWidget* run = dock("run");
  if (!page_.isEmpty() || !sized_ || !run->isVisible() || run->isFloating()) return;
  const int wanted = runHeight(run->width());
  if (wanted <= runHeight_) return;
  runHeight_ = wanted;
  if (run->height() >= wanted) return;
  // Sizes that do not add up to what there is are all made smaller: what is right below gives what the text takes.
  QMap<int, QDockWidget*> below;
  for (QDockWidget* other : all())
    if (isInFront(other) && !other->isFloating() && other->x() == run->x() && other->y() > run->y())
      below[other->y()] = other;
  QList<QDockWidget*> docks{run};
  QList<int> sizes{wanted};
  for (QDockWidget* other : below) {
    sizes << other->height() - (docks.size() == 1 ? wanted - run->height() : 0);
    docks << other;
  }
  window_.resizeDocks(docks, sizes, Qt::Vertical);
}

// The runs' docks get their sizes when they are seen: behind a page they have none.
void DockLayout::sizeOnce() {
  if (!page_.isEmpty()) return sizePage();
  if (!sized_) size();
}

void DockLayout::sizePage() {
  const QStringList shown = shownWith(page_);
  QList<QDockWidget*> docks;
  for (const QString& each : shown) docks << dock(each);
  const int width = window_.width(), left = width * 15 / 100, right = docks.size() > 2 ? width * 27 / 100 : 0;
  const QList<int> widths{left, width - left - right, right};
  window_.resizeDocks(docks, widths.mid(0, docks.size()), Qt::Horizontal);
}

// The page stands behind the first of those that are beside it.
QStringList DockLayout::shownWith(const QString& page) const {
  QStringList shown = pages_[page];
  shown.insert(shown.isEmpty() ? 0 : 1, page);
  return shown;
}

void DockLayout::showPage(const QString& name) {
  if (name == page_) return;
  const QString last = std::exchange(page_, name);
  if (name.isEmpty()) {
    // Hidden first: what is still in the layout would keep its size and leave the others what remains.
    for (QDockWidget* other : all()) other->hide();
    window_.restoreState(std::exchange(before_, {}), Settings::layoutVersion);
    // The pages have no place in that layout.
    for (QDockWidget* other : all())
      if (isPage(other)) other->hide();
    if (!sized_) size();
    QMetaObject::invokeMethod(this, &DockLayout::growRun, Qt::QueuedConnection);
    emit pageChanged(name);
    return;
  }
  if (last.isEmpty()) before_ = window_.saveState(Settings::layoutVersion);
  for (QDockWidget* other : all()) other->hide();
  for (const QString& each : shownWith(name)) {
    QDockWidget* one = dock(each);
    window_.removeDockWidget(one);
    one->setFloating(false);
    window_.addDockWidget(Qt::LeftDockWidgetArea, one, Qt::Horizontal);
    one->show();
  }
  sizePage();
  emit pageChanged(name);
}

void DockLayout::raise(const QString& name) {
  if (!page_.isEmpty() && name != page_ && !pages_[page_].contains(name)) showPage({});
  dock(name)->show();
  dock(name)->raise();
}

bool DockLayout::isInFront(const QDockWidget* dock) {
  // Qt puts docks behind a tab outside of the window instead of hiding them.
  return dock->isVisible() && !dock->visibleRegion().isEmpty();
}

QByteArray DockLayout::state() const {
  return before_.isEmpty() ? window_.saveState(Settings::layoutVersion) : before_;
}

bool DockLayout::restore(const QByteArray& state) {
  sized_ = window_.restoreState(state, Settings::layoutVersion);
  if (sized_) runHeight_ = std::numeric_limits<int>::max();  // as it was left
  for (QDockWidget* other : all())
    if (isPage(other)) other->hide();
  return sized_;
}

}  // namespace btr::ui

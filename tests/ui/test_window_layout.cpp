// The window on the screen: it never grows by itself, fits small screens, and its keys reach what can be seen only.
#include <QAction>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <QTimer>

#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/gap/gap_page.h"
#include "ui/main_window.h"

using namespace btr;
using namespace btr::ui;

namespace {

struct Desk {
  Desk() : theme(*qApp) {
    options.settingsFile = folder.filePath("settings.ini");
    options.program = "/bin/true";
    options.isActive = [](const std::string&, Id) { return false; };
    stored.addWaitingRun(stored.addExperiment());
  }
  std::unique_ptr<MainWindow> open() {
    auto window = std::make_unique<MainWindow>(host, theme, options);
    window->show();
    window->openDatabase(stored.qpath());
    window->bench().reader().waitUntilIdle();
    settle();
    return window;
  }
  static void settle() {
    for (int round = 0; round < 5; ++round) QCoreApplication::processEvents();
  }
  StoredRun stored;
  QTemporaryDir folder;
  std::shared_ptr<const PluginHost> host = std::make_shared<const PluginHost>(PLUGIN_DIR);
  Theme theme;
  WindowOptions options;
};

QAction* action(MainWindow& window, const char* name) {
  auto* found = window.findChild<QAction*>(name);
  if (!found) qFatal("no action %s", name);
  return found;
}

QDockWidget* dockOf(const QWidget* widget) {
  for (QWidget* above = widget->parentWidget(); above; above = above->parentWidget())
    if (auto* dock = qobject_cast<QDockWidget*>(above)) return dock;
  return nullptr;
}

}  // namespace

class TestWindowLayout : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { qputenv("UCHILSIM_RESOURCES", SOURCE_DIR "/resources"); }

  void visitsToPagesLeaveTheSizeAndTheDocksAsTheyWere_data() {
    QTest::addColumn<QSize>("size");
    QTest::newRow("1280x720 with a frame") << QSize(1264, 676);
    QTest::newRow("1366x768 with a frame") << QSize(1350, 724);
    QTest::newRow("large") << QSize(1600, 1000);
  }
  void visitsToPagesLeaveTheSizeAndTheDocksAsTheyWere() {
    QFETCH(QSize, size);
    Desk desk;
    const auto window = desk.open();
    window->resize(size);
    action(*window, "resetLayout")->trigger();
    window->resize(size);
    action(*window, "resetLayout")->trigger();
    window->resize(size);
    Desk::settle();
    QCOMPARE(window->size(), size);
    QMap<QString, QRect> before;
    for (const auto* dock : window->findChildren<QDockWidget*>())
      if (DockLayout::isInFront(dock)) before[dock->objectName()] = dock->geometry();
    for (int visit = 0; visit < 3; ++visit)
      for (const char* page : {"showGapPage", "showGridPage"}) {
        action(*window, page)->trigger();
        Desk::settle();
        QCOMPARE(window->size(), size);
        action(*window, page)->trigger();
        Desk::settle();
        QCOMPARE(window->size(), size);
      }
    for (const auto& [name, place] : before.asKeyValueRange()) {
      const QRect now = window->findChild<QDockWidget*>(name)->geometry();
      QVERIFY2(qAbs(now.width() - place.width()) <= 8 && qAbs(now.height() - place.height()) <= 8,
               qPrintable(QString("%1 %2x%3, before %4x%5")
                              .arg(name)
                              .arg(now.width())
                              .arg(now.height())
                              .arg(place.width())
                              .arg(place.height())));
    }
  }

  // A page that is there from the start: the docks get their sizes when they are first seen.
  void aWindowThatOpensWithAPageHasTheSameDocksBehindIt() {
    Desk desk;
    const auto widthsOf = [](MainWindow& window) {
      QList<int> widths;
      for (const char* name : {"dock.tree", "dock.run", "dock.spec"})
        widths << window.findChild<QDockWidget*>(name)->width();
      return widths;
    };
    MainWindow plain(desk.host, desk.theme, desk.options), paged(desk.host, desk.theme, desk.options);
    for (MainWindow* window : {&plain, &paged}) {
      window->resize(1264, 676);
      window->show();
    }
    paged.showPage("start");
    Desk::settle();
    paged.showPage({});
    Desk::settle();
    const QList<int> wanted = widthsOf(plain), found = widthsOf(paged);
    for (int i = 0; i < wanted.size(); ++i)
      QVERIFY2(qAbs(wanted[i] - found[i]) <= 8, qPrintable(QString("%1, %2").arg(wanted[i]).arg(found[i])));
  }

  // A run says more than "No run is selected": its figures are in sight without a scroll bar as soon as it is read.
  void theFirstLayoutHasRoomForARun_data() {
    QTest::addColumn<bool>("startPage");
    QTest::newRow("run chosen at once") << false;
    QTest::newRow("after the start page") << true;
  }
  void theFirstLayoutHasRoomForARun() {
    QFETCH(bool, startPage);
    Desk desk;
    MainWindow window(desk.host, desk.theme, desk.options);
    window.resize(1264, 676);
    window.show();
    Desk::settle();
    if (startPage) window.showPage("start");
    window.openDatabase(desk.stored.qpath());
    window.bench().reader().waitUntilIdle();
    Desk::settle();
    window.showPage({});
    Desk::settle();
    for (const char* name : {"best", "mean", "trials"}) {
      const auto* figure = window.findChild<QLabel*>(name);
      QVERIFY2(figure->isVisible() && figure->visibleRegion().boundingRect() == figure->rect(), name);
    }
    const auto* run = qobject_cast<QScrollArea*>(window.findChild<QDockWidget*>("dock.run")->widget());
    QVERIFY(!run->verticalScrollBar()->isVisible());
  }

  void aMessageDoesNotCutTheRunsFigures() {
    Desk desk;
    const auto window = desk.open();
    window->resize(1264, 676);
    action(*window, "resetLayout")->trigger();
    window->resize(1264, 676);
    action(*window, "resetLayout")->trigger();
    window->resize(1264, 676);
    Desk::settle();
    const auto* run = qobject_cast<QScrollArea*>(window->findChild<QDockWidget*>("dock.run")->widget());
    QVERIFY(!run->verticalScrollBar()->isVisible());
    window->bench().report("disk full: nothing of this step was stored");
    Desk::settle();
    QVERIFY(!run->verticalScrollBar()->isVisible());
  }

  // Who wants the run's text low keeps it so.
  void whatTheUserMadeLowerStaysLow() {
    Desk desk;
    const auto window = desk.open();
    window->resize(1264, 676);
    Desk::settle();
    auto* run = window->findChild<QDockWidget*>("dock.run");
    window->resizeDocks({run}, {90}, Qt::Vertical);
    Desk::settle();
    const int low = run->height();
    window->findChild<QLabel*>("next")->updateGeometry();
    Desk::settle();
    QCOMPARE(run->height(), low);
  }

  void aGrownWindowIsPutBackByResetLayout() {
    Desk desk;
    const auto window = desk.open();
    window->resize(3000, 2500);
    action(*window, "resetLayout")->trigger();
    Desk::settle();
    const QRect room = window->screen()->availableGeometry();
    QVERIFY(window->width() <= room.width() && window->height() <= room.height());
  }

  void theSizeOfAWindowLargerThanTheScreenIsNotRemembered() {
    Desk desk;
    {
      const auto window = desk.open();
      window->resize(3000, 2500);
      QVERIFY(window->close());
    }
    const auto window = desk.open();
    const QRect room = window->screen()->availableGeometry();
    QVERIFY(window->width() <= room.width() && window->height() <= room.height());
  }

  // On 1280×720 everything that is in front has room to be read, and the button that starts an analysis is in sight.
  void aSmallScreenShowsRowsPlotsAndButtons() {
    Desk desk;
    const auto window = desk.open();
    window->resize(1264, 676);
    action(*window, "resetLayout")->trigger();
    window->resize(1264, 676);
    action(*window, "resetLayout")->trigger();
    window->resize(1264, 676);
    Desk::settle();
    for (const char* name : {"fitness", "sheet", "individuals", "gap", "draft", "replay"}) {
      auto* dock = window->findChild<QDockWidget*>(QString("dock.") + name);
      dock->raise();
      Desk::settle();
      QVERIFY2(DockLayout::isInFront(dock) && dock->height() >= 300, name);
      QVERIFY2(window->rect().contains(dock->geometry()), name);
    }
    action(*window, "showGapPage")->trigger();
    Desk::settle();
    const auto* start = window->gapPage().findChild<QPushButton*>("startAnalysis");
    QCOMPARE(start->visibleRegion().boundingRect(), start->rect());
  }

  // A screen of 1280×720 with a scale factor of 2: the form and all others are tabs beside the tree, wide enough.
  void aNarrowWindowHasItsPanesInTabs() {
    Desk desk;
    const auto window = desk.open();
    for (int round = 0; round < 2; ++round) {
      window->resize(632, 338);
      window->findChild<DockLayout*>()->arrange();
    }
    window->resize(632, 338);
    Desk::settle();
    for (const char* name : {"run", "fitness", "individuals", "sheet", "spec", "draft", "replay"}) {
      auto* dock = window->findChild<QDockWidget*>(QString("dock.") + name);
      dock->raise();
      Desk::settle();
      QVERIFY2(DockLayout::isInFront(dock) && dock->width() >= 400,
               qPrintable(QString("%1 %2").arg(name).arg(dock->width())));
      QVERIFY2(window->rect().contains(dock->geometry()), name);
    }
    QCOMPARE(window->size(), QSize(632, 338));
  }

  // Tab goes through all that can be seen and comes back to where it began; what is behind a tab never gets the focus.
  void dialogsFitTheScreenAndTheirKeysAreKeys() {
    Desk desk;
    auto window = desk.open();
    const QSize room = window->screen()->availableSize();
    int seen = 0;
    const auto look = [&] {
      for (QWidget* each : QApplication::topLevelWidgets()) {
        auto* dialog = qobject_cast<QDialog*>(each);
        if (!dialog || !dialog->isVisible()) continue;
        ++seen;
        QVERIFY2(dialog->width() < room.width() && dialog->height() < room.height() - 20,
                 qPrintable(dialog->windowTitle()));
        // Elsewhere an & is shown as it is.
        for (const QLabel* label : dialog->findChildren<QLabel*>())
          QVERIFY2(!label->text().contains('&') || label->buddy(), qPrintable(label->text()));
        dialog->close();
      }
    };
    QStringList dialogs{"On several machines", "Open interface", "Plugins", "Keyboard shortcuts"};
    for (QAction* menu : window->menuBar()->actions())
      for (QAction* entry : menu->menu()->actions())
        for (const QString& name : dialogs) {
          if (!entry->text().remove('&').startsWith(name)) continue;
          QTimer::singleShot(0, window.get(), look);  // some of them wait until they are closed
          entry->trigger();
          QCoreApplication::processEvents();
        }
    QTRY_COMPARE(seen, int(dialogs.size()));
    for (const QLabel* label : window->findChildren<QLabel*>())
      QVERIFY2(!label->text().contains('&') || label->buddy() || label->textFormat() != Qt::AutoText,
               qPrintable(label->text()));
  }

  void tabGoesRoundThroughWhatIsInFrontOnly() {
    Desk desk;
    const auto window = desk.open();
    window->resize(1264, 676);
    window->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(window.get()));
    QWidget* tree = window->findChild<QWidget*>("experimentTree");
    for (const Qt::Key key : {Qt::Key_Tab, Qt::Key_Backtab}) {
      tree->setFocus();
      QSet<QDockWidget*> docks;
      int steps = 0;
      do {
        QTest::keyClick(window->focusWidget(), key);
        QWidget* focus = window->focusWidget();
        if (QDockWidget* dock = dockOf(focus)) {
          docks << dock;
          QVERIFY2(DockLayout::isInFront(dock), qPrintable(dock->objectName() + ' ' + focus->objectName()));
        }
      } while (window->focusWidget() != tree && ++steps < 600);
      QVERIFY2(steps < 600, qPrintable(window->focusWidget()->objectName()));
      QVERIFY(docks.size() >= 3);
    }
  }

  // Who chooses a pane that is behind a tab wants to see it, not to lose it.
  void theViewMenuBringsPanesToTheFront() {
    Desk desk;
    const auto window = desk.open();
    window->resize(1264, 676);
    action(*window, "resetLayout")->trigger();
    Desk::settle();
    auto* sheet = window->findChild<QDockWidget*>("dock.sheet");
    window->findChild<QDockWidget*>("dock.fitness")->raise();
    Desk::settle();
    QVERIFY(!DockLayout::isInFront(sheet));
    const auto choose = [&] {
      emit window->findChild<QMenu*>("menu.view")->aboutToShow();
      const bool isTicked = action(*window, "see.sheet")->isChecked();
      action(*window, "see.sheet")->trigger();
      Desk::settle();
      return isTicked;
    };
    QVERIFY(!choose());
    QVERIFY(DockLayout::isInFront(sheet));
    QVERIFY(sheet->isAncestorOf(window->focusWidget()));
    QVERIFY(choose());
    QVERIFY(!sheet->isVisible());
    QVERIFY(!choose());
    QVERIFY(DockLayout::isInFront(sheet));
    window->showPage("analysis");
    Desk::settle();
    QVERIFY(!choose());
    QVERIFY(DockLayout::isInFront(sheet));
  }

  void noEntryStandsTwiceInAMenu() {
    Desk desk;
    const auto window = desk.open();
    for (const QAction* top : window->menuBar()->actions()) {
      QStringList texts;
      for (const QAction* entry : top->menu()->actions())
        if (!entry->isSeparator()) texts << entry->text().remove('&');
      QVERIFY2(texts.removeDuplicates() == 0, qPrintable(top->text()));
    }
  }
};

UI_TEST(TestWindowLayout)
#include "test_window_layout.moc"

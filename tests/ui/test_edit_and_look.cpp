// The Edit menu acts on what has the focus; the look changes while the window is open.
#include <QApplication>
#include <QClipboard>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QTest>

#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/experiment/experiment_form.h"
#include "ui/main_window.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/measurement_view.h"

using namespace btr;
using namespace btr::ui;

namespace {

struct Desk {
  Desk() : theme(*qApp) {
    options.settingsFile = folder.filePath("settings.ini");
    options.program = "/bin/true";
    options.isActive = [](const std::string&, Id) { return false; };
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 3);
    for (const auto& task : stored.addTasks(run)) stored.measure(run, task.individual, 0.25);
    stored.finishStage(run, {{"friction", 0.5}});
    stored.addGenerations(run, 3);
    stored.addTasks(run);
  }
  std::unique_ptr<MainWindow> open() {
    auto window = std::make_unique<MainWindow>(host, theme, options);
    window->resize(1500, 900);
    window->show();
    window->activateWindow();
    window->openDatabase(stored.qpath());
    window->bench().reader().waitUntilIdle();
    QTest::qWait(50);  // what is shown follows from events
    return window;
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

void raise(MainWindow& window, const char* dock) {
  auto* found = window.findChild<QDockWidget*>(dock);
  found->show();
  found->raise();
  QTest::qWait(20);
}

double lightness(const QImage& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height(); y += 3)
    for (int x = 0; x < picture.width(); x += 3) sum += qGray(picture.pixel(x, y));
  return sum / (((picture.height() + 2) / 3) * ((picture.width() + 2) / 3)) / 255;
}

/// How light the icons of the visible labels are, the darkest and the lightest; transparent pixels do not count.
std::pair<double, double> iconLightness(MainWindow& window) {
  double darkest = 1, lightest = 0;
  for (const QLabel* label : window.findChildren<QLabel*>()) {
    const QImage icon = label->pixmap().toImage();
    if (!label->isVisible() || icon.isNull()) continue;
    double sum = 0, weight = 0;
    for (int y = 0; y < icon.height(); ++y)
      for (int x = 0; x < icon.width(); ++x) {
        const QColor colour = icon.pixelColor(x, y);
        sum += colour.alphaF() * colour.lightnessF();
        weight += colour.alphaF();
      }
    if (weight == 0) continue;
    darkest = std::min(darkest, sum / weight);
    lightest = std::max(lightest, sum / weight);
  }
  return {darkest, lightest};
}

}  // namespace

class TestEditAndLook : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { qputenv("UCHILSIM_RESOURCES", SOURCE_DIR "/resources"); }

  void theMenuShowsTheStandardKeysAndTakesNoneAway() {
    Desk desk;
    const auto window = desk.open();
    const std::pair<const char*, QKeySequence::StandardKey> entries[] = {
        {"edit.undo", QKeySequence::Undo},   {"edit.redo", QKeySequence::Redo},
        {"edit.cut", QKeySequence::Cut},     {"edit.copy", QKeySequence::Copy},
        {"edit.paste", QKeySequence::Paste}, {"edit.selectAll", QKeySequence::SelectAll}};
    for (const auto& [name, key] : entries) QCOMPARE(action(*window, name)->shortcut(), QKeySequence(key));

    // Ctrl+Z still reaches the form.
    raise(*window, "dock.draft");
    auto* name = window->draft().findChild<QLineEdit*>();
    name->setFocus();
    const QString before = name->text();
    QTest::keyClicks(name, "x");
    QVERIFY(name->text() != before);
    QTest::keyClick(name, Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(name->text(), before);
  }

  void undoAndRedoActOnTheFocusedForm() {
    Desk desk;
    const auto window = desk.open();
    raise(*window, "dock.draft");
    auto* name = window->draft().findChild<QLineEdit*>();
    name->setFocus();
    QVERIFY(name->hasFocus());
    const QString before = name->text();
    QTest::keyClicks(name, "more");
    const QString after = name->text();
    action(*window, "edit.undo")->trigger();
    QCOMPARE(name->text(), before);
    action(*window, "edit.redo")->trigger();
    QCOMPARE(name->text(), after);
    action(*window, "edit.selectAll")->trigger();
    QCOMPARE(name->selectedText(), after);
    action(*window, "edit.cut")->trigger();
    QCOMPARE(QApplication::clipboard()->text(), after);
    QCOMPARE(name->text(), QString());
    action(*window, "edit.paste")->trigger();
    QCOMPARE(name->text(), after);
  }

  void copyPasteAndUndoActOnTheSheet() {
    Desk desk;
    const auto window = desk.open();
    raise(*window, "dock.sheet");
    auto* sheet = window->findChild<MeasurementSheet*>();
    MeasurementView& view = sheet->view();
    view.setFocus();
    QVERIFY(view.hasFocus());
    QModelIndex cell;
    for (int column = 0; column < sheet->model().columnCount() && !cell.isValid(); ++column)
      if (sheet->model().index(0, column).flags() & Qt::ItemIsEditable) cell = sheet->model().index(0, column);
    QVERIFY(cell.isValid());
    view.setCurrentIndex(cell);
    QApplication::clipboard()->setText("0.75");
    action(*window, "edit.paste")->trigger();
    QCOMPARE(cell.data(Qt::EditRole).toString(), QString("0.75"));
    action(*window, "edit.undo")->trigger();
    QCOMPARE(cell.data(Qt::EditRole).toString(), QString());
    action(*window, "edit.redo")->trigger();
    QCOMPARE(cell.data(Qt::EditRole).toString(), QString("0.75"));
    QApplication::clipboard()->clear();
    action(*window, "edit.cut")->trigger();
    QCOMPARE(QApplication::clipboard()->text(), QString("0.75"));
    QCOMPARE(cell.data(Qt::EditRole).toString(), QString());
  }

  void withoutFocusNothingHappens() {
    Desk desk;
    const auto window = desk.open();
    if (QWidget* focus = QApplication::focusWidget()) focus->clearFocus();
    for (const char* name : {"edit.undo", "edit.redo", "edit.cut", "edit.copy", "edit.paste", "edit.selectAll"})
      action(*window, name)->trigger();
  }

  void theLookChangesLiveWithItsIcons() {
    Desk desk;
    const auto window = desk.open();
    for (const bool dark : {false, true, false, true}) {
      action(*window, dark ? "look.dark" : "look.light")->trigger();
      QTest::qWait(50);
      const QImage picture = window->grab().toImage();
      const QString folder = qEnvironmentVariable("UCHILSIM_TEST_PICTURES");
      if (!folder.isEmpty()) picture.save(folder + (dark ? "/dark.png" : "/light.png"));
      QVERIFY(dark ? lightness(picture) < 0.35 : lightness(picture) > 0.6);
      const auto [darkest, lightest] = iconLightness(*window);
      QVERIFY(lightest > 0 && darkest < 1);
      QVERIFY2(dark ? darkest > 0.5 : lightest < 0.5, qPrintable(QString("%1 %2").arg(darkest).arg(lightest)));
    }
  }
};

UI_TEST(TestEditAndLook)
#include "test_edit_and_look.moc"

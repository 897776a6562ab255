// The manual from the window: F1 finds the chapter of the dock with the focus, and says so when there is no manual.
#include <QAction>
#include <QDesktopServices>
#include <QDir>
#include <QDockWidget>
#include <QFile>
#include <QLineEdit>
#include <QMessageBox>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QTreeView>

#include "core/plugin/plugin_host.h"
#include "core/store/database.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/look/theme.h"
#include "ui/common/manual.h"
#include "ui/main_window.h"

using namespace btr;
using namespace btr::ui;

// Takes the place of the browser.
class Browser : public QObject {
  Q_OBJECT
 public:
  Browser() { QDesktopServices::setUrlHandler("file", this, "show"); }
  ~Browser() override { QDesktopServices::unsetUrlHandler("file"); }
  QList<QUrl> shown;
 public slots:
  void show(const QUrl& url) { shown << url; }
};

class TestManual : public QObject {
  Q_OBJECT

  std::shared_ptr<const PluginHost> host = std::make_shared<const PluginHost>(PLUGIN_DIR);

  static QString filePart(const QString& page) { return page.section('#', 0, 0); }

 private slots:
  void everyDockHasAPageThatIsBuilt() {
    QTemporaryDir folder;
    Theme theme(*qApp);
    MainWindow window(host, theme, {.settingsFile = folder.filePath("settings.ini")});
    const auto docks = window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly);
    QVERIFY(docks.size() >= 10);
    for (const QDockWidget* dock : docks) {
      const QString page = Manual::pageFor(dock);
      QVERIFY2(page != "index.html", qPrintable(dock->objectName() + " has no chapter"));
      QFile file(Manual::standardFolder() + '/' + filePart(page));
      QVERIFY2(file.open(QIODevice::ReadOnly), qPrintable(file.fileName()));
      if (const QString anchor = page.section('#', 1); !anchor.isEmpty())
        QVERIFY2(file.readAll().contains("id=\"" + anchor.toUtf8() + '"'), qPrintable(page));
    }
    QVERIFY(QFile::exists(Manual::standardFolder() + "/index.html"));
  }

  void f1ShowsTheChapterOfTheWidgetWithTheFocus() {
    QTemporaryDir folder;
    Theme theme(*qApp);
    MainWindow window(host, theme, {.settingsFile = folder.filePath("settings.ini")});
    window.show();
    QVERIFY(QTest::qWaitForWindowActive(&window));
    Browser browser;
    auto* tree = window.findChild<QDockWidget*>("dock.tree")->findChild<QTreeView*>();
    tree->setFocus();
    QTest::keyClick(tree, Qt::Key_F1);
    QCOMPARE(browser.shown.size(), 1);
    QCOMPARE(browser.shown[0].toLocalFile(), Manual::standardFolder() + "/first-run.html");

    window.showPage("analysis");
    QWidget* dock = window.findChild<QDockWidget*>("dock.analysis");
    QTRY_VERIFY(dock->isVisible());
    QWidget* field = nullptr;
    for (QLineEdit* edit : dock->findChildren<QLineEdit*>())
      if (edit->isVisible() && edit->isEnabled()) field = edit;
    QVERIFY(field);
    field->setFocus();
    QTest::keyClick(field, Qt::Key_F1);
    QCOMPARE(browser.shown.size(), 2);
    QCOMPARE(browser.shown[1].toLocalFile(), Manual::standardFolder() + "/gap-analysis.html");
  }

  void aPageKeepsItsPlaceWithin() {
    QTemporaryDir folder;
    QVERIFY(QFile(folder.filePath("charts.html")).open(QIODevice::WriteOnly));
    Browser browser;
    QCOMPARE(Manual(folder.path()).open("charts.html#replay"), QString());
    QCOMPARE(browser.shown.size(), 1);
    QCOMPARE(browser.shown[0].fragment(), "replay");
    QCOMPARE(browser.shown[0].toLocalFile(), folder.filePath("charts.html"));
  }

  void aManualThatIsNotThereSaysWhereItWasLookedFor() {
    QTemporaryDir folder;
    Browser browser;
    const QString problem = Manual(folder.filePath("none")).open("charts.html#replay");
    QVERIFY2(problem.contains(folder.filePath("none/charts.html")), qPrintable(problem));
    QVERIFY(browser.shown.isEmpty());
  }

  void aboutShowsTheVersion() {
    QTemporaryDir folder;
    Theme theme(*qApp);
    MainWindow window(host, theme, {.settingsFile = folder.filePath("settings.ini")});
    window.show();
    QString text;
    QTimer::singleShot(0, &window, [&] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) {
        text = box->text();
        box->reject();
      }
    });
    window.findChild<QAction*>("help.about")->trigger();
    QVERIFY2(text.contains(QString::fromStdString(programVersion())), qPrintable(text));
  }
};

UI_TEST(TestManual)
#include "test_manual.moc"

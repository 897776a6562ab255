// Help, Plugins: what was loaded, by whom, from where; what was not, and why.
#include <QLabel>
#include <QTableWidget>
#include <QTest>
#include <filesystem>
#include <fstream>

#include "core/plugin/plugin_host.h"
#include "tests/temporary_folder.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/plugins_dialog.h"

namespace btr::ui {

class TestPluginsDialog : public QObject {
  Q_OBJECT
 private slots:
  void namesEachPluginWithVersionAuthorLicenceAndPath();
  void namesWhatWasNotLoadedAndWhy();
};

void TestPluginsDialog::namesEachPluginWithVersionAuthorLicenceAndPath() {
  const PluginHost host(PLUGIN_DIR);
  const PluginsDialog dialog(host);
  const auto* table = dialog.findChild<QTableWidget*>("plugins");
  QVERIFY(table);
  QCOMPARE(table->rowCount(), int(host.plugins().size()));
  const auto found = table->findItems("coulomb_friction", Qt::MatchExactly);
  QCOMPARE(found.size(), 1);
  const int row = found.first()->row();
  QCOMPARE(table->item(row, 0)->text(), QString("effect"));
  QVERIFY(!table->item(row, 2)->text().isEmpty());
  QCOMPARE(table->item(row, 3)->text(), QString("UCHILSIM"));
  QCOMPARE(table->item(row, 4)->text(), QString("GPL-3.0-or-later"));
  QCOMPARE(table->item(row, 5)->text(), QString(PLUGIN_DIR "/effects/coulomb_friction.so"));
  QVERIFY(!dialog.findChild<QTableWidget*>("failures"));
}

void TestPluginsDialog::namesWhatWasNotLoadedAndWhy() {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::create_directories(folder / "effects");
  std::ofstream(folder / "effects" / "text.so") << "this is no library";
  const PluginHost host(std::vector<std::string>{PLUGIN_DIR, folder.string()});
  const PluginsDialog dialog(host);
  const auto* table = dialog.findChild<QTableWidget*>("failures");
  QVERIFY(table);
  QCOMPARE(table->rowCount(), 1);
  QCOMPARE(table->item(0, 0)->text().toStdString(), (folder / "effects" / "text.so").string());
  QVERIFY(table->item(0, 1)->text().contains("cannot be loaded"));
}

}  // namespace btr::ui

UI_TEST(btr::ui::TestPluginsDialog)
#include "test_plugins_dialog.moc"

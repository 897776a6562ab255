// Numbers in the window have a decimal point, whatever the user's locale says.
#include "tests/ui/ui_tests.h"
#include "ui/common/numbers/plain_numbers.h"

#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QLocale>
#include <QTest>
#include <clocale>
#include <memory>

#include "core/plugin/plugin_host.h"
#include "core/spec/experiment_spec.h"
#include "tests/ui/open_live_page.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/parameter_form.h"

using namespace btr;
using namespace btr::ui;

class TestPlainNumbers : public QObject {
  Q_OBJECT
 private slots:
  // A German locale of the C library need not be installed; any other one is as good a witness.
  void theCLibraryReadsAndWritesPoints() {
    QVERIFY(std::setlocale(LC_NUMERIC, "C.utf8"));
    QLocale::setDefault(QLocale(QLocale::German));
    usePlainNumbers();
    QCOMPARE(std::string(std::setlocale(LC_NUMERIC, nullptr)), std::string("C"));
    QCOMPARE(QLocale().decimalPoint(), QString("."));
  }

  void aFormAndItsFileHavePointsInAGermanWindow() {
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    ExperimentForm form(offersOf(plugins()));
    form.setSpec(loadExperiment(SOURCE_DIR "/resources/experiments/walk.json"));
    auto* simulator = form.findChild<ParameterForm*>("simulator");
    QVERIFY(simulator);
    for (const QLineEdit* edit : form.findChildren<QLineEdit*>())
      if (edit->objectName() != "name") QVERIFY2(!edit->text().contains(','), qPrintable(edit->text()));
    ExperimentSpec spec = form.spec();
    QCOMPARE(experimentFromJson(toJsonText(spec), "text", spec.directory), spec);
    QLocale::setDefault(QLocale::c());
  }

  void spinBoxesOfTheScenePageTakeACommaAndShowAPoint() {
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("crate");
    int seen = 0;
    for (QDoubleSpinBox* box : open.page.findChildren<QDoubleSpinBox*>()) {
      if (box->maximum() < 0.2) continue;
      QVERIFY2(!box->text().contains(','), qPrintable(box->objectName() + ": " + box->text()));
      auto* edit = box->findChild<QLineEdit*>();
      QString typed = "0,1";
      int position = 3;
      // A field of whole numbers has no use for it.
      QVERIFY2(box->decimals() == 0 || box->validate(typed, position) != QValidator::Invalid,
               qPrintable(box->objectName()));
      QVERIFY(edit);
      ++seen;
    }
    QVERIFY(seen > 0);
    QLocale::setDefault(QLocale::c());
  }
};

UI_TEST(TestPlainNumbers)
#include "test_plain_numbers.moc"

// Numbers beside sliders: what is typed is in force, or said not to be.
#include <QLabel>
#include <QSignalSpy>
#include <QTest>

#include "tests/ui/ui_tests.h"
#include "ui/common/numbers/number_edit.h"
#include "ui/live/panels/slider_form.h"

using namespace btr;
using namespace btr::ui;

namespace {

void type(NumberEdit& number, const char* text) {
  number.setFocus();
  number.selectAll();
  QTest::keyClicks(&number, text);
  QTest::keyClick(&number, Qt::Key_Return);
}

}  // namespace

class TestSliderForm : public QObject {
  Q_OBJECT

 private slots:
  void aNumberThatIsNotAllowedDoesNotStay() {
    SliderForm form;
    form.setParameters({{"length_m", "m", "half of a stride", 0.03, 0.11, 0.06}}, {});
    form.setVisible(true);
    auto& number = *form.findChild<NumberEdit*>("number.length_m");
    auto& refused = *form.findChild<QLabel*>("refused");
    QSignalSpy edited(&form, &SliderForm::edited);
    type(number, "0.08");
    QCOMPARE(form.value("length_m"), 0.08);
    const auto said = edited.size();
    for (const char* wrong : {"5", "0", ""}) {
      type(number, wrong);
      QCOMPARE(number.numberText(), QString("0.08"));
      QCOMPARE(form.value("length_m"), 0.08);
      QVERIFY(refused.isVisible());
      const QString words = refused.text().simplified();  // numbers and units keep together
      QVERIFY2(words.contains("a number from 0.03 to 0.11 m") && words.contains("it stays 0.08 m"), qPrintable(words));
    }
    QCOMPARE(edited.size(), said);
    type(number, "0.1");
    QCOMPARE(form.value("length_m"), 0.1);
    QVERIFY(refused.isHidden());
  }
};

UI_TEST(TestSliderForm)
#include "test_slider_form.moc"

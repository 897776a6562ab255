// The form made from declared parameters: values in, values out, marks, bold, undo.
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTest>
#include <QToolButton>
#include <QUndoStack>
#include <QVBoxLayout>
#include <QWheelEvent>

#include "tests/ui/ui_tests.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/decimal_spin_box.h"
#include "ui/common/numbers/number_edit.h"
#include "ui/experiment/parameter_field.h"
#include "ui/experiment/parameter_form.h"
#include "ui/experiment/parameter_text.h"
#include "ui/experiment/plugin_form.h"

using namespace btr;
using namespace btr::ui;

namespace {

std::vector<Parameter> someParameters() {
  return {{"leg_mass_kg", "kg", "mass of one leg", 0.1, 0.5, 0.2},
          {"population", "", "individuals in a generation", 2, 1000, 40, {}, true},
          {"coding", "", "how a number becomes bits", 0, 1, 0, {}, false, {"binary", "gray"}}};
}

// Types into a field as a person does: select all, then the keys.
void type(QWidget* field, const QString& text) {
  auto* edit = field->findChild<QLineEdit*>();
  edit->setFocus();
  edit->selectAll();
  QTest::keyClicks(edit, text);
}

}  // namespace

class TestParameterForm : public QObject {
  Q_OBJECT
 private slots:
  void labelsLeaveTheUnitToTheUnitColumn() {
    QCOMPARE(labelOf({"leg_mass_kg", "kg", ""}), QString("Leg mass"));
    QCOMPARE(labelOf({"gravity_m_s2", "m/s²", ""}), QString("Gravity"));
    QCOMPARE(labelOf({"slip1_m_s_n", "m/(s·N)", ""}), QString("Slip1"));
    QCOMPARE(labelOf({"servo_d_nm_s_rad", "N·m·s/rad", ""}), QString("Servo d"));
    QCOMPARE(labelOf({"k_rad2", "1/rad²", ""}), QString("K"));
    QCOMPARE(labelOf({"first_generations", "", ""}), QString("First generations"));
  }

  void showsDefaultsAndGivesNoValuesWhenNothingWasSet() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    QCOMPARE(form.findChild<NumberEdit*>("leg_mass_kg")->numberText(), QString("0.2"));
    QVERIFY(form.values().empty());
    QVERIFY(form.isValid());
    QCOMPARE(form.changedCount(), 0);
  }

  void givesBackEveryBitOfTheValuesItWasGiven() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    const Values values{{"leg_mass_kg", 0.1 + 0.2}, {"population", 40}, {"coding", 1}};
    form.setValues(values);
    QCOMPARE(form.values(), values);
    QCOMPARE(form.findChild<QComboBox*>("coding")->currentText(), QString("gray"));
  }

  void keepsNamesThatAreNotDeclared() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    const Values values{{"floor.friction", 0.3}};
    form.setValues(values);
    QCOMPARE(form.values(), values);
  }

  void marksWhatDiffersFromTheDefaultInBold() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.show();
    type(form.findChild<NumberEdit*>("leg_mass_kg"), "0.25");
    QCOMPARE(form.values(), (Values{{"leg_mass_kg", 0.25}}));
    bool bold = false;
    for (auto* label : form.findChildren<QLabel*>())
      bold = bold || (label->text() == "Leg mass" && label->font().bold());
    QVERIFY(bold);
    QVERIFY(form.findChild<QToolButton*>("leg_mass_kg.reset")->isVisible());
    QVERIFY(!form.findChild<QToolButton*>("population.reset")->isVisible());
    QCOMPARE(form.changedCount(), 1);
  }

  void boldStaysWhenTheFormIsShownLaterInAStyledWindow() {
    Theme theme(*qApp);
    theme.apply(Look::light);
    QUndoStack undo;
    QDockWidget dock;
    auto* form = new ParameterForm(someParameters(), undo, &dock);
    form->setValues({{"leg_mass_kg", 0.25}});
    dock.setWidget(form);
    dock.show();
    for (auto* label : form->findChildren<QLabel*>())
      if (label->text() == "Leg mass" || label->text() == "Population")
        QCOMPARE(label->font().bold(), label->text() == "Leg mass");
  }

  void marksInvalidInputWhereItStandsAndSaysWhatIsAllowed() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.show();
    QSignalSpy valid(&form, &ParameterForm::validChanged);
    auto* field = form.findChild<NumberEdit*>("population");
    auto* problem = form.findChild<QLabel*>("population.problem");
    QVERIFY(!problem->isVisible());

    type(field, "1");
    QVERIFY(!form.isValid());
    QVERIFY(problem->isVisible());
    QCOMPARE(problem->text(), QString("1 is not allowed; a whole number from 2 to 1000"));
    QVERIFY(field->findChild<QLineEdit*>()->styleSheet().contains("border"));
    QCOMPARE(form.problems(), QStringList{"Population: " + problem->text()});

    type(field, "2.5");
    QVERIFY(!form.isValid());
    type(field, "x");
    QVERIFY(!form.isValid());
    type(field, "12");
    QVERIFY(form.isValid());
    QVERIFY(!problem->isVisible());
    QVERIFY(field->findChild<QLineEdit*>()->styleSheet().isEmpty());
    QCOMPARE(form.values(), (Values{{"population", 12}}));
    // 1 no, 2 yes, 2.5 no (x no, 1 no), 12 yes: said once a change.
    QCOMPARE(valid.count(), 4);
    QCOMPARE(valid.last().first().toBool(), true);
  }

  void undoesAnEditAsAWholeAndRedoesIt() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.show();
    QApplication::setActiveWindow(&form);
    type(form.findChild<NumberEdit*>("population"), "123");
    type(form.findChild<NumberEdit*>("leg_mass_kg"), "0.4");
    QCOMPARE(undo.count(), 2);
    undo.undo();
    QCOMPARE(form.values(), (Values{{"population", 123}}));
    undo.undo();
    QVERIFY(form.values().empty());
    QCOMPARE(form.findChild<NumberEdit*>("population")->numberText(), QString("40"));
    undo.redo();
    undo.redo();
    QCOMPARE(form.values(), (Values{{"leg_mass_kg", 0.4}, {"population", 123}}));
  }

  void undoBringsBackFromInvalidInput() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    type(form.findChild<NumberEdit*>("population"), "0");
    QVERIFY(!form.isValid());
    undo.undo();
    QVERIFY(form.isValid());
  }

  void resetsOneFieldAndAllFieldsToTheirDefaults() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.setValues({{"leg_mass_kg", 0.3}, {"population", 7}, {"coding", 1}});
    form.findChild<QToolButton*>("population.reset")->click();
    QCOMPARE(form.values(), (Values{{"leg_mass_kg", 0.3}, {"coding", 1}}));
    form.resetAll();
    QVERIFY(form.values().empty());
    undo.undo();
    QCOMPARE(form.values(), (Values{{"leg_mass_kg", 0.3}, {"coding", 1}}));
  }

  void stepsWithTheArrowKeysWithinTheRange() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    auto* field = form.findChild<NumberEdit*>("population");
    QTest::keyClick(field, Qt::Key_Up);
    QCOMPARE(form.values(), (Values{{"population", 41}}));
    form.setValues({{"population", 1000}});
    QTest::keyClick(field, Qt::Key_Up);
    QCOMPARE(form.values(), (Values{{"population", 1000}}));
    auto* mass = form.findChild<NumberEdit*>("leg_mass_kg");
    QTest::keyClick(mass, Qt::Key_Down);
    QCOMPARE(form.values().at("leg_mass_kg"), 0.199);
  }

  void choosesAWordByKeyboard() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    QTest::keyClick(form.findChild<QComboBox*>("coding"), Qt::Key_Down);
    QCOMPARE(form.values(), (Values{{"coding", 1}}));
  }

  void saysMeaningUnitAndRangeToAReaderAndInTheToolTip() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    auto* field = form.findChild<NumberEdit*>("leg_mass_kg");
    QCOMPARE(field->accessibleName(), QString("Leg mass [kg]"));
    QVERIFY(field->accessibleDescription().contains("mass of one leg; a number from 0.1 to 0.5 kg"));
    QVERIFY(field->toolTip().contains("from 0.1 to 0.5 kg"));
    QVERIFY(field->toolTip().contains("leg_mass_kg"));
  }

  void findsFieldsByNameAndMeaning() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo, {.checkable = false, .filterFrom = 2});
    form.show();
    QTest::keyClicks(form.findChild<QLineEdit*>("search"), "individuals");
    QVERIFY(form.findChild<NumberEdit*>("population")->isVisible());
    QVERIFY(!form.findChild<NumberEdit*>("leg_mass_kg")->isVisible());
  }

  void aDecimalCommaIsReadAsInTheSheet() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.show();
    auto* mass = form.findChild<NumberEdit*>("leg_mass_kg");
    type(mass, "0,25");
    QCOMPARE(form.values(), (Values{{"leg_mass_kg", 0.25}}));
    QVERIFY(form.isValid());
    QTest::keyClick(mass, Qt::Key_Up);
    QCOMPARE(mass->numberText(), QString("0.251"));
    type(mass, "0.2,5");
    QVERIFY(!form.isValid());
  }

  void aFieldThatIsLeftShowsAPointForTheCommaAndItIsOneStepOfUndo() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.show();
    auto* mass = form.findChild<NumberEdit*>("leg_mass_kg");
    type(mass, "0,25");
    QTest::keyClick(mass, Qt::Key_Return);
    QCOMPARE(mass->numberText(), QString("0.25"));
    QCOMPARE(form.values(), (Values{{"leg_mass_kg", 0.25}}));
    QCOMPARE(undo.count(), 1);
    type(mass, "0,2,5");
    QTest::keyClick(mass, Qt::Key_Return);
    QCOMPARE(mass->numberText(), QString("0,2,5"));
    QVERIFY(!form.isValid());
  }

  void theNumbersOfThePageReadACommaAndPrintAPoint() {
    const QLocale german(QLocale::German);
    const QLocale before;
    QLocale::setDefault(german);
    DecimalSpinBox box;
    QLocale::setDefault(before);
    box.setRange(0, 2000);
    box.setDecimals(2);
    box.show();
    type(&box, "0,25");
    QCOMPARE(box.value(), 0.25);
    QCOMPARE(box.text(), QString("0.25"));
    box.setValue(1234.5);
    QCOMPARE(box.text(), QString("1234.50"));
  }

  // A form is scrolled with the pointer wherever it happens to be, and the field may have the focus.
  void theWheelScrollsTheFormAndChangesNothing() {
    QUndoStack undo;
    QScrollArea area;
    auto* inside = new QWidget;
    auto* column = new QVBoxLayout(inside);
    PluginForm learner(tr("Learner"), {{"ga", someParameters(), ""}, {"pgrl", someParameters(), ""}}, undo);
    column->addWidget(&learner);
    auto* spin = new QSpinBox;
    column->addWidget(spin);
    column->addSpacing(2000);
    area.setWidget(inside);
    area.setWidgetResizable(true);
    area.resize(400, 200);
    area.show();
    QVERIFY(QTest::qWaitForWindowActive(&area));
    for (QWidget* field : std::initializer_list<QWidget*>{
             learner.findChild<QComboBox*>(), spin, learner.findChild<NumberEdit*>("population"),
             learner.findChild<NumberEdit*>("population")->findChild<QLineEdit*>()}) {
      field->setFocus();
      const int before = area.verticalScrollBar()->value();
      const QPointF at = field->rect().center();
      QWheelEvent wheel(at, field->mapToGlobal(at), {}, {0, -120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
      QSpontaneKeyEvent::setSpontaneous(&wheel);  // as from the mouse: only such events go on to the parents
      qApp->notify(field, &wheel);
      QVERIFY(area.verticalScrollBar()->value() > before);
    }
    QCOMPARE(learner.choice().name, std::string("ga"));
    QVERIFY(learner.choice().settings.empty());
    QCOMPARE(spin->value(), 0);
    QCOMPARE(undo.count(), 0);
    learner.setParent(nullptr);
  }

  void readOnlyFieldsCannotBeTypedInto() {
    QUndoStack undo;
    ParameterForm form(someParameters(), undo);
    form.setReadOnly(true);
    type(form.findChild<NumberEdit*>("population"), "99");
    QTest::keyClick(form.findChild<NumberEdit*>("population"), Qt::Key_Up);
    QVERIFY(form.values().empty());
  }
};

UI_TEST(TestParameterForm)
#include "test_parameter_form.moc"

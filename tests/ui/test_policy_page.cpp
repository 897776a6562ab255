// The page of L2: what it says of an iteration.
#include <QComboBox>
#include <QLabel>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTabWidget>
#include <QTableWidget>
#include <QTest>

#include "tests/ui/ui_tests.h"
#include "ui/measure/policy_page.h"

using namespace btr;
using namespace btr::ui;

namespace {

const std::vector<Parameter> genotype{{"length_mm", "mm", "", 0, 100, 50}, {"speed_mm_s", "mm/s", "", 0, 300, 100}};

/// Nine policies, all pairs of changes; the first parameter adds 10 for each ε, the second decides nothing.
RealityReport report(int number, bool finished) {
  RealityReport report;
  report.stage = 1;
  report.number = number;
  report.isFinished = finished;
  const std::vector<double> centre{50, 100}, epsilons{2, 10};
  std::vector<std::vector<double>> policies;
  std::vector<double> fitness;
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b) {
      PolicyRow& row = report.policies.emplace_back();
      row.individual = 100 + Id(report.policies.size());
      row.parameters = {50 + 2.0 * a, 100 + 10.0 * b};
      row.changes = {a, b};
      row.simulated = 20;
      row.fitness = 20 + 10 * a + 0.1 * ((a + b + 4) % 3);
      row.count = 3;
      row.standardError = 0.5;
      policies.push_back(row.parameters);
      fitness.push_back(*row.fitness);
    }
  const PolicyGradient gradient = policyGradient(genotype, centre, epsilons, 1, policies, fitness);
  for (std::size_t n = 0; n < 2; ++n) {
    StepRow& s = report.steps.emplace_back();
    s.parameter = genotype[n];
    s.centreBefore = centre[n];
    s.gradient = gradient.parameters[n];
    if (finished) s.centreAfter = gradient.centre[n];
  }
  return report;
}

}  // namespace

class TestPolicyPage : public QObject {
  Q_OBJECT
 private slots:
  void showsAveragesWithErrorsTheStepAndWhatIsNotSignificant() {
    PolicyPage page;
    page.setUnit("mm/s");
    page.setReports({report(1, true)});
    auto* steps = page.findChild<QTableWidget*>("steps");
    const auto text = [&](int row, int column) { return steps->item(row, column)->text(); };
    QCOMPARE(steps->rowCount(), 2);
    QCOMPARE(text(0, PolicyPage::parameter), QString("length_mm [mm]"));
    QVERIFY2(text(0, PolicyPage::below).startsWith("10.1 ± 0.058"), qPrintable(text(0, PolicyPage::below)));
    QVERIFY2(text(0, PolicyPage::above).startsWith("30.1 ± "), qPrintable(text(0, PolicyPage::above)));
    QVERIFY(text(0, PolicyPage::above).endsWith("(3)"));
    QCOMPARE(steps->horizontalHeaderItem(PolicyPage::above)->text(), QString("Mean at +ε [mm/s]"));
    QCOMPARE(text(0, PolicyPage::verdict), QString("significant"));
    QCOMPARE(text(0, PolicyPage::step), QString("+2"));
    QCOMPARE(text(0, PolicyPage::after), QString("52"));
    QVERIFY(text(1, PolicyPage::verdict) == "not significant" || text(1, PolicyPage::verdict) == "stays");
    auto* policies = page.findChild<QTableWidget*>("policies");
    QCOMPARE(policies->rowCount(), 9);
    QCOMPARE(policies->item(0, PolicyPage::changes)->text(), QString("−−"));
    QCOMPARE(policies->horizontalHeaderItem(PolicyPage::real)->text(), QString("Real [mm/s]"));
    QVERIFY(page.findChild<QLabel*>("sentence")->text().contains("of 2 parameters moved"));
  }

  // Three policies, one in each group: no scatter, so nothing is known of chance.
  void tooFewPoliciesTellNothing() {
    PolicyPage page;
    RealityReport few = report(1, true);
    const PolicyGradient gradient =
        policyGradient(genotype, std::vector{50.0, 100.0}, std::vector{2.0, 10.0}, 1,
                       std::vector<std::vector<double>>{{48, 90}, {50, 100}, {52, 110}}, std::vector{1.0, 2.0, 3.0});
    for (std::size_t n = 0; n < 2; ++n) {
      few.steps[n].gradient = gradient.parameters[n];
      few.steps[n].centreAfter = gradient.centre[n];
    }
    page.setReports({few});
    auto* steps = page.findChild<QTableWidget*>("steps");
    QCOMPARE(steps->item(0, PolicyPage::pValue)->text(), QString("–"));
    QCOMPARE(steps->item(0, PolicyPage::verdict)->text(), QString("too few policies to tell"));
    QCOMPARE(page.findChild<QLabel*>("sentence")->text(),
             QString("2 of 2 parameters moved: too few policies to tell their differences from chance."));
  }

  void anIterationThatWaitsHasNoStepYet() {
    PolicyPage page;
    RealityReport waiting = report(2, false);
    waiting.policies[0].fitness.reset();
    page.setReports({report(1, true), waiting});
    QCOMPARE(page.findChild<QComboBox*>("iteration")->currentText(), QString("Stage 1, iteration 2"));
    QVERIFY(page.findChild<QLabel*>("sentence")->text().startsWith("8 of 9 policies are measured"));
    auto* steps = page.findChild<QTableWidget*>("steps");
    QCOMPARE(steps->item(0, PolicyPage::step)->text(), QString("–"));
    // Nobody shall measure what he expects.
    QCOMPARE(page.findChild<QTableWidget*>("policies")->item(0, PolicyPage::simulated)->text(), QString("hidden"));
  }

  // CMA-ES in reality: an empty table of steps would look like a fault.
  void aLearnerWithoutStepsShowsItsPolicies() {
    PolicyPage page;
    RealityReport population = report(1, true);
    population.steps.clear();
    page.setReports({population});
    const auto* tables = page.findChild<QTabWidget*>();
    QCOMPARE(tables->currentWidget(), page.findChild<QTableWidget*>("policies"));
    QVERIFY(!tables->isTabVisible(0));
    page.setReports({report(1, true)});
    QVERIFY(tables->isTabVisible(0));
  }

  void keepsTheIterationThatTheUserLooksAt() {
    PolicyPage page;
    page.setReports({report(1, true), report(2, true)});
    page.findChild<QComboBox*>("iteration")->setCurrentIndex(0);
    page.setReports({report(1, true), report(2, true), report(3, false)});
    QCOMPARE(page.findChild<QComboBox*>("iteration")->currentIndex(), 0);
    page.findChild<QComboBox*>("iteration")->setCurrentIndex(2);
    page.setReports({report(1, true), report(2, true), report(3, true), report(4, false)});
    QCOMPARE(page.findChild<QComboBox*>("iteration")->currentIndex(), 3);
  }

  void withoutL2ItSaysSo() {
    PolicyPage page;
    page.setReports({report(1, true)});
    page.setReports({});
    QCOMPARE(page.findChild<QTableWidget*>("steps")->rowCount(), 0);
    QVERIFY(page.findChild<QLabel*>("sentence")->text().contains("has not learned in reality"));
  }

  void endingL2AsksFirstAndIsOfferedOnlyWhileItWaits() {
    PolicyPage page;
    page.setReports({report(1, false)});
    page.show();
    auto* end = page.findChild<QPushButton*>("endL2");
    QVERIFY(!end->isVisible());
    page.setWaiting(true);
    QVERIFY(end->isVisible());
    QSignalSpy ended(&page, &PolicyPage::endRequested);
    end->click();
    auto* box = page.findChild<QMessageBox*>();
    QVERIFY(box && box->isVisible());
    box->reject();
    QCOMPARE(ended.size(), 0);
    QTRY_VERIFY(!page.findChild<QMessageBox*>());
    end->click();
    page.findChild<QPushButton*>("confirmEnd")->click();
    QCOMPARE(ended.size(), 1);
  }

  void anIterationThatAPersonEndedSaysThatNoStepWasTaken() {
    PolicyPage page;
    RealityReport ended = report(1, true);
    ended.wasEnded = true;
    ended.policies[3].fitness.reset();
    page.setReports({ended});
    const QString text = page.findChild<QLabel*>("sentence")->text();
    QVERIFY2(text.contains("after 8 of 9 policies") && text.contains("no step"), qPrintable(text));
  }

  void aPolicyIsReplayedByADoubleClick() {
    PolicyPage page;
    page.setReports({report(1, true)});
    QSignalSpy asked(&page, &PolicyPage::replayRequested);
    emit page.findChild<QTableWidget*>("policies")->cellDoubleClicked(4, 0);
    QCOMPARE(asked.size(), 1);
    QCOMPARE(asked[0][0].value<Id>(), Id(105));
  }
};

UI_TEST(TestPolicyPage)
#include "test_policy_page.moc"

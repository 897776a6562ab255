// The form of a whole experiment: nothing is lost between file, form and file.
#include <QComboBox>
#include <QLabel>
#include <QLayout>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalSpy>
#include <QTest>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/numbers/number_edit.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/parameter_form.h"
#include "ui/experiment/search_start.h"

using namespace btr;
using namespace btr::ui;

namespace {

ExperimentOffers someOffers() {
  const std::vector<Parameter> ga{{"population", "", "individuals", 2, 1000, 40, {}, true},
                                  {"coding", "", "how a number becomes bits", 0, 1, 0, {}, false, {"binary", "gray"}}};
  return {{{"kick", {{"distance_m", "m", "to the target", 0.1, 3, 1}}, {}}, {"walk", {}, {}}},
          {{"kick_distance", {{"k", "", "weight of the direction", 0, 10, 1}}, "how far [m]"}},
          {{"ga", ga, {}}}};
}

/// The same with a learner that has a step for each parameter of what it searches.
ExperimentOffers offersWithSteps() {
  ExperimentOffers offers = someOffers();
  const std::vector<Parameter> plain{{"policies", "", "of an iteration", 3, 100, 15, {}, true}};
  std::vector<Parameter> kick = plain;
  kick.push_back({"epsilon_length_mm", "mm", "step", 0, 10, 0});
  const PluginForm::Offer ga = offers.learners.front();
  offers.learners = offers.adapters = {ga, {"pgrl", plain, {}}};
  offers.learnersOf = {{"kick", {ga, {"pgrl", kick, {}}}}, {"walk", {ga, {"pgrl", plain, {}}}}};
  return offers;
}

ExperimentSpec aSpec() {
  ExperimentSpec spec;
  spec.name = "Kick";
  spec.scene = "../scenes/kick.json";
  spec.directory = SOURCE_DIR "/resources/experiments";
  spec.controller = {"kick", {{"distance_m", 0.1 + 0.2}}, {}};
  spec.fitness = {"kick_distance", {}, {}};
  spec.learner = {"ga", {{"population", 30}}, {{"coding", "gray"}}};
  spec.stages = {{"first_generations", 20}, {"measured_individuals", 5}};
  spec.adaptation = {"ga", {}, {}};
  spec.adaptationSettings = {{"norm", 1}, {"held_out", 2}};
  spec.adapted = {"friction", "leg_mass_kg"};
  spec.simulator.values = {{"friction", 0.7}, {"robots.dog.links.head.mass_kg", 0.2}};
  spec.simulator.effects = {{"backlash", "dog.LF_J1", {{"width_rad", 0.02}}}};
  spec.reality = "stand_in";
  spec.standIn = {{"seed", 7}, {"drawn_by", 1}};
  spec.concealed = {{"backlash"}, {"dog.LF_J3"}};
  spec.recordings = {{{"after_stage", 1}, {"robot", 1}}, {"servo_p_nm_rad"}, {"backlash"}, {"dog.LF_J3"}};
  spec.seed = 9007199254740991;
  return spec;
}

void type(QLineEdit* edit, const QString& text) {
  edit->setFocus();
  edit->selectAll();
  QTest::keyClicks(edit, text);
}

}  // namespace

class TestExperimentForm : public QObject {
  Q_OBJECT
 private slots:
  // A dock on a screen of 1280 × 720 is 330 pixels wide.
  void nothingIsCutOffInANarrowDock() {
    const PluginHost host(PLUGIN_DIR);
    ExperimentForm form(offersOf(host));
    ExperimentSpec spec;
    spec.controller = {"kick", {}, {}};
    spec.fitness = {"kick_distance", {}, {}};
    spec.learner = spec.adaptation = {"ga", {}, {}};
    form.setSpec(spec);
    form.resize(330, 560);
    form.show();
    QVERIFY(QTest::qWaitForWindowExposed(&form));
    // Several controllers have a field of that name: the one that is seen.
    const auto seen = [&](const QString& name) -> QWidget* {
      for (QWidget* widget : form.findChildren<QWidget*>(name))
        if (widget->isVisible()) return widget;
      return nullptr;
    };
    QWidget* distance = seen("distance_m");
    QVERIFY(distance);
    type(distance->findChild<QLineEdit*>(), "99999");
    const auto* area = form.findChild<QScrollArea*>();
    QTRY_VERIFY(area->widget()->width() <= area->viewport()->width());
    QCOMPARE(area->horizontalScrollBar()->maximum(), 0);
    for (const char* name : {"distance_m.problem", "distance_m.reset", "reality"}) {
      const QWidget* widget = seen(name);
      QVERIFY2(widget, name);
      QVERIFY2(widget->mapTo(area->widget(), QPoint(widget->width(), 0)).x() <= area->viewport()->width(), name);
    }
  }

  // Narrower than any form can be, it is scrolled.
  void whatDoesNotFitCanBeScrolledTo() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    form.resize(200, 400);
    form.show();
    const auto* area = form.findChild<QScrollArea*>();
    QTRY_VERIFY(area->widget()->width() <= area->viewport()->width() + area->horizontalScrollBar()->maximum());
  }

  void aLongNameIsSeenFromItsBeginning() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    spec.name = std::string(300, 'a');
    form.setSpec(spec);
    QCOMPARE(form.findChild<QLineEdit*>("name")->cursorPosition(), 0);
  }

  void givesBackTheSameExperiment() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    QVERIFY2(form.isValid(), qPrintable(form.problems().join('\n')));
    QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(toJsonText(aSpec())));
  }

  void givesBackTheSameExperimentAfterAFile() {
    ExperimentForm form(someOffers());
    const std::string text = toJsonText(aSpec());
    form.setSpec(experimentFromJson(text, "kick.json", "/somewhere"));
    QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(text));
    QCOMPARE(form.spec().directory, std::string("/somewhere"));
  }

  void learningInRealityIsThereOnlyWithALearner() {
    ExperimentForm form(offersWithSteps());
    form.setSpec(aSpec());
    QCOMPARE(form.spec().realityLearner.name, std::string());
    ExperimentSpec spec = aSpec();
    spec.realityLearner = {"pgrl", {{"policies", 7}, {"epsilon_length_mm", 2}}, {}};
    spec.realitySettings = {{"iterations", 4}, {"gives_back", 1}};
    form.setSpec(spec);
    QVERIFY2(form.isValid(), qPrintable(form.problems().join('\n')));
    QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(toJsonText(spec)));
    spec.realityLearner.settings["epsilon_nobody"] = 1;
    QVERIFY_EXCEPTION_THROWN(form.setSpec(spec), InputError);
  }

  void theVectorThatASearchBeginsAroundGoesInAndOut() {
    ExperimentOffers offers = someOffers();
    offers.startsOf["kick"] =
        startOffers({{"height_mm", "mm", "of the hip", 50, 120, 90}, {"points", "", "", 2, 9, 4, {}, true}});
    ExperimentForm form(offers);
    form.setSpec(aSpec());
    QVERIFY(!form.spec().start);
    ExperimentSpec spec = aSpec();
    spec.start = SearchStart{{{"height_mm", 101.5}, {"points", 3}}, 0.5, 0.1};
    form.setSpec(spec);
    QVERIFY2(form.isValid(), qPrintable(form.problems().join('\n')));
    QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(toJsonText(spec)));

    auto* height = form.findChild<QWidget*>("searchStart")->findChild<NumberEdit*>("height_mm");
    QVERIFY(height);
    type(height->findChild<QLineEdit*>(), "130");
    QVERIFY(!form.isValid());
    QVERIFY2(form.problems().join('\n').contains("120"), qPrintable(form.problems().join('\n')));
    form.undoStack().undo();
    QVERIFY(form.isValid());
    QCOMPARE(form.spec().start->parameters.at("height_mm"), 101.5);

    spec.start->parameters["nobody"] = 1;
    QVERIFY_THROWS_EXCEPTION(InputError, form.setSpec(spec));
  }

  void moreDisagreeingThanMeasuredIndividualsIsSaid() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    spec.stages["disagreeing_individuals"] = 6;
    form.setSpec(spec);
    QVERIFY(!form.isValid());
    QVERIFY(form.problems().join('\n').contains("at most the 5 measured"));
  }

  void aLearnersStepsFollowTheController() {
    ExperimentForm form(offersWithSteps());
    ExperimentSpec spec = aSpec();
    spec.learner = {"pgrl", {{"policies", 7}, {"epsilon_length_mm", 2}}, {}};
    form.setSpec(spec);
    auto* controllers = form.findChild<QWidget*>("controller")->findChild<QComboBox*>();
    const auto choose = [&](const QString& name) {
      const int index = controllers->findText(name);
      controllers->setCurrentIndex(index);
      emit controllers->activated(index);
    };
    choose("walk");
    QCOMPARE(form.spec().learner.settings, (Values{{"policies", 7}}));
    form.undoStack().undo();
    QCOMPARE(form.spec().learner.settings, (Values{{"policies", 7}, {"epsilon_length_mm", 2}}));
    form.undoStack().redo();
    QCOMPARE(form.spec().controller.name, std::string("walk"));
    QVERIFY(form.isValid());
  }

  void refusesASettingThatThePluginDoesNotAllowAndKeepsWhatItShows() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    ExperimentSpec wrong = aSpec();
    wrong.name = "Wrong";
    wrong.learner.settings["population"] = 1;
    QVERIFY_THROWS_EXCEPTION(InputError, form.setSpec(wrong));
    QCOMPARE(form.spec().name, std::string("Kick"));
  }

  void anUnknownPluginIsShownAndForbidsTheStart() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    spec.controller = {"swim", {{"depth_m", 2}}, {}};
    form.setSpec(spec);
    QVERIFY(!form.isValid());
    QVERIFY(form.problems().first().contains("swim is not installed"));
    QVERIFY(!form.findChild<QPushButton*>("start")->isEnabled());
    QCOMPARE(form.spec().controller, spec.controller);
  }

  void saysWhatIsMissingInAnEmptyExperiment() {
    ExperimentForm form(someOffers());
    QVERIFY(!form.isValid());
    QVERIFY(form.problems().join(' ').contains("Scene"));
    QVERIFY(!form.findChild<QPushButton*>("start")->isEnabled());
  }

  void saysWhereASceneIsNot() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    type(form.findChild<QLineEdit*>("scene"), "../scenes/absent.json");
    QCOMPARE(form.problems(),
             QStringList{"Scene: there is no such file: " SOURCE_DIR "/resources/experiments/../scenes/absent.json"});
    QVERIFY(!form.findChild<QPushButton*>("start")->isEnabled());
    type(form.findChild<QLineEdit*>("scene"), SOURCE_DIR "/resources/scenes/walk.json");
    QVERIFY(form.isValid());
  }

  void undoTakesBackNameAndRealityAndParameters() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    QVERIFY(!form.isModified());
    type(form.findChild<QLineEdit*>("name"), "Other");
    QCOMPARE(form.spec().name, std::string("Other"));
    auto* reality = form.findChild<QComboBox*>("reality");
    QTest::keyClick(reality, Qt::Key_Up);
    QCOMPARE(form.spec().reality, std::string("person"));
    type(form.findChild<ParameterForm*>("stages")->findChild<NumberEdit*>("repeats")->findChild<QLineEdit*>(), "3");
    QCOMPARE(form.spec().stages.at("repeats"), 3.0);
    QVERIFY(form.isModified());
    QCOMPARE(form.undoStack().count(), 3);
    for (int i = 0; i < 3; ++i) form.undoStack().undo();
    QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(toJsonText(aSpec())));
    QVERIFY(!form.isModified());
  }

  void theKeyForUndoReachesTheFormFromANumberField() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    form.show();
    QVERIFY(QTest::qWaitForWindowActive(&form));
    auto* number = form.findChild<ParameterForm*>("stages")->findChild<NumberEdit*>("repeats");
    number->setFocus();
    number->selectAll();
    QTest::keyClick(number, Qt::Key_3);
    QCOMPARE(form.spec().stages.at("repeats"), 3.0);
    QTest::keyClick(number, Qt::Key_Z, Qt::ControlModifier);
    QVERIFY(!form.isModified());
    QVERIFY(!form.spec().stages.count("repeats"));
  }

  void tabGoesThroughTheFormAsItStands() {
    ExperimentForm form(offersWithSteps());
    ExperimentSpec spec = aSpec();
    spec.controller = {"walk", {}, {}};
    form.setSpec(spec);
    form.resize(500, 3000);
    form.show();
    QVERIFY(QTest::qWaitForWindowActive(&form));
    form.findChild<QLineEdit*>("name")->setFocus();
    // From top to bottom, and in a line from left to right.
    QStringList seen;
    int last = -1;
    while (seen.size() < 60) {
      QWidget* now = form.focusWidget();
      const int y = now->mapTo(&form, QPoint(0, now->height() / 2)).y();
      QVERIFY2(y > last - 8, qPrintable(seen.join(", ") + " then " + now->objectName()));
      last = y;
      seen << now->objectName();
      if (now->objectName() == "repeats") break;
      QTest::keyClick(now, Qt::Key_Tab);
    }
    QCOMPARE(seen.last(), QString("repeats"));
  }

  void aShortPluginLeavesNoHoleForALongOne() {
    ExperimentOffers offers = someOffers();
    std::vector<Parameter> many;
    for (int i = 0; i < 30; ++i)
      many.push_back({"a_setting_whose_name_wraps_in_a_narrow_form_" + std::to_string(i), "mm", "", 0, 1, 0});
    offers.learners.push_back({"long", many, "and its hint wraps as well, as it is a sentence of several words"});
    QUndoStack undo;
    const auto heightOf = [&](const std::vector<PluginForm::Offer>& some) {
      PluginForm form("Learner", some, undo);
      form.setChoice({"ga", {}, {}});
      form.ensurePolished();
      return form.layout()->hasHeightForWidth() ? form.layout()->totalHeightForWidth(300)
                                                : form.layout()->totalSizeHint().height();
    };
    QCOMPARE(heightOf(offers.learners), heightOf({offers.learners.front()}));
  }

  void choosingAnotherPluginKeepsTheSettingsOfTheFirst() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    auto* names = form.findChild<QWidget*>("controller")->findChild<QComboBox*>();
    QTest::keyClick(names, Qt::Key_Down);
    QCOMPARE(form.spec().controller.name, std::string("walk"));
    QTest::keyClick(names, Qt::Key_Up);
    QCOMPARE(form.spec().controller, aSpec().controller);
  }

  void labelsTheStandInRealityClearly() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    form.setSpec(spec);
    form.show();
    auto* note = form.findChild<QLabel*>("standInNote");
    QVERIFY(note->isVisible());
    QVERIFY(
        note->text().startsWith("Stand-in reality: a simulated robot with concealed parameters, for demonstration"));
    spec.reality = "person";
    form.setSpec(spec);
    QVERIFY(!note->isVisible());
  }

  void anEmptyListOfAdaptedParametersMeansAll() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    spec.adapted.clear();
    form.setSpec(spec);
    auto* simulator = form.findChild<ParameterForm*>("simulator");
    QCOMPARE(simulator->checked().size(), simulatorParameters().size());
    QVERIFY(form.spec().adapted.empty());
    simulator->setChecked({"friction"});
    QCOMPARE(form.spec().adapted, std::vector<std::string>{"friction"});
    simulator->setChecked({});
    QVERIFY(!form.isValid());
  }

  void onlyParametersOfTheScenesRobotsAreShown() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    spec.adapted.clear();
    spec.simulator = {};
    form.setSpec(spec);
    form.show();
    auto* simulator = form.findChild<ParameterForm*>("simulator");
    for (const Parameter& p : simulatorParameters()) QVERIFY2(simulator->shows(p.name), p.name.c_str());
    spec.scene = "../scenes/quadruped.json";  // no AIBO
    form.setSpec(spec);
    for (const char* name : {"head_mass_kg", "neck_mass_kg", "body_mass_kg", "leg_mass_kg", "servo_p_nm_rad"})
      QVERIFY2(!simulator->shows(name), name);
    for (const char* name : {"gravity_m_s2", "friction", "slip1_m_s_n"}) QVERIFY2(simulator->shows(name), name);
    QVERIFY(form.isValid());
    QVERIFY(form.spec().adapted.empty());  // all that there are
    simulator->setChecked({"friction", "leg_mass_kg"});
    QCOMPARE(form.spec().adapted, std::vector<std::string>{"friction"});
    simulator->setChecked({"leg_mass_kg"});
    QVERIFY(!form.isValid());
    // By typing another scene, and back.
    type(form.findChild<QLineEdit*>("scene"), "../scenes/kick.json");
    QVERIFY(simulator->shows("leg_mass_kg"));
    type(form.findChild<QLineEdit*>("scene"), "../scenes/quadruped.json");
    QVERIFY(!simulator->shows("leg_mass_kg"));
    // What the experiment itself says of others stays seen: it has to be mended.
    spec.simulator.values = {{"leg_mass_kg", 0.3}};
    form.setSpec(spec);
    QVERIFY(simulator->shows("leg_mass_kg"));
    QCOMPARE(form.spec().simulator.values.at("leg_mass_kg"), 0.3);
  }

  void saysWhatIsRecordedAndWhatTheStandInConceals() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    form.show();
    QVERIFY(form.findChild<QLabel*>("concealed")->text().contains("backlash; at: dog.LF_J3"));
    QVERIFY(!form.findChild<QLabel*>("concealed")->isHidden());
    QVERIFY(form.findChild<QLabel*>("recorded")->text().contains("Joints compared: dog.LF_J3"));
    ExperimentSpec none = aSpec();
    none.recordings = {};
    none.concealed = {};
    form.setSpec(none);
    QVERIFY(form.findChild<QLabel*>("concealed")->isHidden());
    QVERIFY(form.findChild<QLabel*>("recorded")->isHidden());
  }

  void refusesMoreHeldOutThanMeasured() {
    ExperimentForm form(someOffers());
    ExperimentSpec spec = aSpec();
    spec.adaptationSettings["held_out"] = 5;
    form.setSpec(spec);
    QCOMPARE(form.problems(), QStringList{"Held out: less than the 5 measured individuals"});
  }

  /// A controller that wants a file has a line for it beside its numbers.
  void aControllersPathGoesInAndOut() {
    ExperimentOffers offers = someOffers();
    offers.controllers.push_back({"openr", {{"duration_s", "s", "how long", 0.1, 600, 10}}, {}, {"stick"}});
    ExperimentForm form(offers);
    ExperimentSpec spec = aSpec();
    spec.controller = {"openr", {{"duration_s", 4}}, {{"stick", "../openr/PanPath/MS"}}};
    form.setSpec(spec);
    QVERIFY2(form.isValid(), qPrintable(form.problems().join('\n')));
    QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(toJsonText(spec)));
    auto* stick = form.findChild<QLineEdit*>("openr.stick");
    QCOMPARE(stick->text(), QString("../openr/PanPath/MS"));
    type(stick, "other");
    QCOMPARE(form.spec().controller.words.at("stick"), std::string("other"));
    form.undoStack().undo();
    QCOMPARE(form.spec().controller.words.at("stick"), std::string("../openr/PanPath/MS"));
    spec.controller.words.clear();
    form.setSpec(spec);
    QVERIFY(!form.isValid());
    QVERIFY2(form.problems().join('\n').contains("stick"), qPrintable(form.problems().join('\n')));
  }

  /// What evolves of such a controller stands in the file: a search may begin around it, whatever the form offers
  /// without.
  void aSearchBeginsAroundParametersThatStandInAFile() {
    ExperimentOffers offers = someOffers();
    offers.controllers.push_back({"openr", {{"duration_s", "s", "how long", 0.1, 600, 10}}, {}, {"stick"}});
    offers.startsOf["openr"] = startOffers({});
    std::vector<std::string> read;
    bool isThere = true;
    offers.genotypeOf = [&](const std::string&, const std::map<std::string, std::string>& paths) {
      read.push_back(paths.at("stick"));
      if (!isThere) throw InputError("no such stick");
      return std::vector<Parameter>{{"pan_p", "", "gain", 1, 64, 8, {}, true}};
    };
    ExperimentSpec spec = aSpec();
    spec.directory = "/experiments";
    spec.controller = {"openr", {{"duration_s", 4}}, {{"stick", "../openr/MS"}}};
    spec.start = SearchStart{};
    spec.start->parameters = {{"pan_p", 12}};
    const auto expectKept = [&](ExperimentForm& form) {
      form.setSpec(spec);
      QCOMPARE(QString::fromStdString(toJsonText(form.spec())), QString::fromStdString(toJsonText(spec)));
    };
    ExperimentForm form(offers);
    expectKept(form);
    QCOMPARE(QString::fromStdString(read.front()), QString("/openr/MS"));
    // The file's bounds hold.
    ExperimentSpec wrong = spec;
    wrong.start->parameters["pan_p"] = 100;
    QVERIFY_THROWS_EXCEPTION(InputError, form.setSpec(wrong));
    // A stick that is not there does not keep the experiment from being looked at and mended.
    isThere = false;
    ExperimentForm without(offers);
    expectKept(without);
  }

  void aReadOnlyFormOffersACopyInsteadOfAStart() {
    ExperimentForm form(someOffers());
    form.setSpec(aSpec());
    form.setReadOnly("Stored run");
    form.show();
    QSignalSpy copy(&form, &ExperimentForm::copyRequested);
    QVERIFY(!form.findChild<QPushButton*>("start")->isVisible());
    form.findChild<QPushButton*>("copy")->click();
    QCOMPARE(copy.count(), 1);
    type(form.findChild<QLineEdit*>("name"), "Other");
    QCOMPARE(form.spec().name, std::string("Kick"));
  }
};

UI_TEST(TestExperimentForm)
#include "test_experiment_form.moc"

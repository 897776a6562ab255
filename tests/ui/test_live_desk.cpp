// The desk beside a running world: several objects at once, simulator numbers and effects, two sets of parameters,
// joints and pulls by keyboard, the palette.
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QSlider>
#include <QTabWidget>
#include <QTableWidget>
#include <QToolButton>
#include <cmath>

#include "core/spec/error.h"
#include "tests/ui/open_live_page.h"
#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/database/database_reader.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/numbers/number_edit.h"
#include "ui/live/free_place.h"
#include "ui/live/live_tools.h"
#include "ui/live/panels/individual_dialog.h"
#include "ui/live/panels/joints_panel.h"
#include "ui/live/panels/parameter_sets.h"
#include "ui/live/panels/selection_panel.h"
#include "ui/live/panels/signal_picker.h"
#include "ui/live/panels/signals_panel.h"
#include "ui/live/panels/simulator_panel.h"
#include "ui/live/panels/slider_form.h"
#include "ui/live/panels/thing_palette.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// The game as the world's own process has it.
Game toldGame(LivePage& page) {
  bool told = false;
  const auto connection = QObject::connect(&page.process(), &LiveProcess::gameTold, [&] { told = true; });
  page.process().askGame();
  const bool came = QTest::qWaitFor([&] { return told; }, 10000);
  QObject::disconnect(connection);
  return came ? page.game() : Game{};
}

/// NaN: it is the scene's.
double toldNumber(LivePage& page, const std::string& name) {
  const Values values = toldGame(page).simulator.values;
  return values.contains(name) ? values.at(name) : std::nan("");
}

void type(QWidget* number, const QString& text) {
  auto* line = number->findChild<QLineEdit*>();
  line->setFocus();
  line->selectAll();
  QTest::keyClicks(line, text);
}

void showPanel(LivePage& page, const QString& title) {
  auto* tabs = page.findChild<QTabWidget*>("livePanels");
  for (int i = 0; i < tabs->count(); ++i)
    if (tabs->tabText(i) == title) tabs->setCurrentIndex(i);
}

Eigen::Vector3d placeOf(LivePage& page, const std::string& object) { return page.world().poseOf(object).translation(); }

bool isNear(double a, double b, double within) { return std::abs(a - b) < within; }

}  // namespace

class TestLiveDesk : public QObject {
  Q_OBJECT
 private slots:
  void severalObjectsAreMovedDuplicatedAndTakenAway() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("ball");
    open.tree()->setCurrentItem(open.tree()->itemOf("crate"), 0, QItemSelectionModel::Select);
    QCOMPARE(open.page.world().selection(), (std::vector<std::string>{"ball", "crate"}));
    QTest::keyClick(&open.page.view(), Qt::Key_Right, Qt::ShiftModifier);
    QTRY_VERIFY(isNear(placeOf(open.page, "ball").x(), 0.2, 1e-9) &&
                isNear(placeOf(open.page, "crate").x(), 0.2, 1e-9));
    // Led together by the mouse.
    emit open.page.view().ledTo("ball", {0.2, -0.3, 0.0425});
    emit open.page.view().letGo("ball");
    QTRY_VERIFY(isNear(placeOf(open.page, "ball").y(), -0.3, 1e-9));
    QVERIFY(isNear(placeOf(open.page, "crate").y(), 0.05, 1e-9));

    QTest::keyClick(&open.page.view(), Qt::Key_D, Qt::ControlModifier);
    QTRY_COMPARE(open.count(), std::size_t(5));
    QTRY_VERIFY(open.page.world().isReady());
    open.picture("several");
    QTRY_COMPARE(open.page.world().selection(), (std::vector<std::string>{"ball2", "crate2"}));
    QTRY_VERIFY(open.page.world().isReady());
    QVERIFY((placeOf(open.page, "ball2") - placeOf(open.page, "ball")).norm() >= 2 * 0.0425);
    QVERIFY(isNear(placeOf(open.page, "crate2").z(), placeOf(open.page, "crate").z(), 1e-9));
    QTest::keyClick(&open.page.view(), Qt::Key_Delete);
    QTRY_COMPARE(open.count(), std::size_t(3));

    // A robot with its joints and its player.
    open.select("dog");
    open.action("liveDuplicate")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(4));
    QTRY_VERIFY(open.page.world().isReady());
    QCOMPARE(open.page.game().robots.at("dog2").controller->plugin, std::string("walk"));
    QVERIFY((placeOf(open.page, "dog2") - placeOf(open.page, "dog")).norm() > 0.3);
    const auto joints = [&](const std::string& name) {
      return open.page.world().scene().jointsOf(std::size_t(open.page.world().indexOf(name)), open.page.row());
    };
    const Values of = joints("dog");
    QVERIFY(of.size() >= 18);
    for (const auto& [joint, position] : of) QVERIFY2(isNear(position, joints("dog2").at(joint), 1e-9), joint.c_str());
  }

  void aNameIsChangedInTheTree() {
    OpenPage open;
    QVERIFY(open.isThere());
    const Eigen::Vector3d at = placeOf(open.page, "ball");
    open.tree()->itemOf("ball")->setText(0, "puck");
    QTRY_VERIFY(open.tree()->itemOf("puck") && !open.tree()->itemOf("ball"));
    QTRY_VERIFY(open.page.world().isReady());
    QVERIFY((placeOf(open.page, "puck") - at).norm() < 1e-9);
    QTRY_COMPARE(open.page.world().selected(), std::string("puck"));
    open.tree()->itemOf("puck")->setText(0, "crate");  // taken
    QVERIFY(open.page.findChild<MessageBanner*>()->text().contains("crate"));
    QVERIFY(open.tree()->itemOf("puck"));
  }

  void simulatorNumbersTakeEffectAndGoBack() {
    OpenPage open;
    QVERIFY(open.isThere());
    showPanel(open.page, "Simulator");
    auto* panel = open.page.findChild<SimulatorPanel*>();
    auto* numbers = panel->findChild<SliderForm*>("liveNumbers");
    // The scene's friction is 1, the ERS-7's masses are its file's.
    QCOMPARE(numbers->value("friction"), 1.0);
    QCOMPARE(numbers->changedCount(), 0);
    type(numbers->findChild<QWidget*>("number.friction"), "0.5");
    QTRY_COMPARE(open.page.game().simulator.values.size(), std::size_t(1));
    QCOMPARE(toldNumber(open.page, "friction"), 0.5);
    open.picture("simulator");
    QVERIFY(panel->findChild<QLabel*>("liveDifferences")->text().contains("friction = 0.5"));
    QCOMPARE(numbers->changedCount(), 1);
    // What is not allowed is marked and not sent.
    type(numbers->findChild<QWidget*>("number.friction"), "9");
    QTest::qWait(200);
    QCOMPARE(toldNumber(open.page, "friction"), 0.5);
    numbers->findChild<QSlider*>("slider.gravity_m_s2")->setValue(1000);
    QTRY_COMPARE(toldNumber(open.page, "gravity_m_s2"), 10.8);
    numbers->findChild<QToolButton*>("back.friction")->click();
    QTRY_VERIFY(!toldGame(open.page).simulator.values.contains("friction"));
    panel->findChild<QPushButton*>("liveResetNumbers")->click();
    QVERIFY(toldGame(open.page).simulator.values.empty());

    // A joint's own number, of the robot's own simulator.
    open.select("dog");
    auto* group = panel->findChild<QComboBox*>("liveNumberGroup");
    group->setCurrentIndex(group->findText("joint LF_J1"));
    emit group->activated(group->currentIndex());
    type(numbers->findChild<QWidget*>("number.p"), "3");
    QTRY_VERIFY(open.page.game().robots.at("dog").simulator.has_value());
    QCOMPARE(toldGame(open.page).robots.at("dog").simulator->values.at("robots.dog.servos.LF_J1.p"), 3.0);
  }

  void effectsAreAddedTunedAndTakenAway() {
    OpenPage open;
    QVERIFY(open.isThere());
    showPanel(open.page, "Simulator");
    auto* panel = open.page.findChild<SimulatorPanel*>();
    auto* effect = panel->findChild<QComboBox*>("liveEffect");
    effect->setCurrentText("backlash");
    auto* place = panel->findChild<QComboBox*>("liveEffectPlace");
    place->setCurrentText("dog.LF_J2");
    QCOMPARE(place->currentText(), QString("dog.LF_J2"));
    panel->findChild<QPushButton*>("liveAddEffect")->click();
    QCOMPARE(panel->findChild<QListWidget*>("liveEffects")->count(), 1);
    Game game = toldGame(open.page);
    QCOMPARE(game.simulator.effects.size(), std::size_t(1));
    QCOMPARE(game.simulator.effects[0].text(), std::string("backlash at dog.LF_J2"));
    QCOMPARE(game.simulator.effects[0].parameters.at("width_rad"), 0.02);
    auto* form = panel->findChild<SliderForm*>("liveEffectParameters");
    type(form->findChild<QWidget*>("number.width_rad"), "0.1");
    QTRY_COMPARE(toldGame(open.page).simulator.effects[0].parameters.at("width_rad"), 0.1);
    open.picture("effects");
    panel->findChild<QPushButton*>("liveRemoveEffect")->click();
    QVERIFY(toldGame(open.page).simulator.effects.empty());
    QCOMPARE(panel->findChild<QListWidget*>("liveEffects")->count(), 0);
  }

  void twoSetsOfParametersAreSwitchedWhileItRuns() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("dog");
    LivePage& page = open.page;
    auto* sets = page.findChild<ParameterSets*>();
    const auto length = [&] { return page.game().robots.at("dog").controller->parameters.at("length_m"); };
    type(page.findChild<QWidget*>("number.length_m"), "0.05");
    page.findChild<QToolButton*>("liveStoreA")->click();
    type(page.findChild<QWidget*>("number.length_m"), "0.08");
    page.findChild<QToolButton*>("liveStoreB")->click();
    QVERIFY(page.signalsPanel().picker().choose("dog.LF_J1.position_rad", true));
    open.action("livePlay")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(page.row().period > 20, 20000);
    page.findChild<QPushButton*>("liveUseA")->click();
    QCOMPARE(toldGame(page).robots.at("dog").controller->parameters.at("length_m"), 0.05);
    page.view().setFocus();
    QTest::keyClick(&page.view(), Qt::Key_X);
    QCOMPARE(length(), 0.08);
    QCOMPARE(toldGame(page).robots.at("dog").controller->parameters.at("length_m"), 0.08);
    QVERIFY(page.findChild<QPushButton*>("liveUseB")->isChecked());
    page.signalsPanel().draw();
    const auto& marks = page.signalsPanel().plot("rad")->data().markers;
    QCOMPARE(marks.size(), std::size_t(2));
    QCOMPARE(marks[0].label, QString("dog: A"));
    QCOMPARE(marks[1].label, QString("dog: B"));
    open.picture("sets");
    // As files.
    const QString file = open.folder.filePath("a.json");
    sets->save(0, file);
    sets->load(1, file);
    QTest::keyClick(&page.view(), Qt::Key_X);
    QTest::keyClick(&page.view(), Qt::Key_X);
    QCOMPARE(length(), 0.05);
    writeFile(file.toStdString(), R"({"format": "uchilsim-parameters-1", "plugin": "kick", "parameters": {}})");
    QVERIFY_EXCEPTION_THROWN(sets->load(1, file), InputError);
  }

  void aJointIsHeldAtAnAngle() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("dog");
    showPanel(open.page, "Joints");
    auto* panel = open.page.findChild<JointsPanel*>();
    auto* angle = panel->findChild<QDoubleSpinBox*>("number.HEAD_PAN");
    if (!angle) {
      QStringList names;
      for (auto* box : panel->findChildren<QDoubleSpinBox*>()) names << box->objectName();
      QFAIL(qPrintable(names.join(' ')));
    }
    const std::string joint = "HEAD_PAN";
    auto* hold = panel->findChild<QCheckBox*>("hold.HEAD_PAN");
    angle->setValue(30);
    QVERIFY(hold->isChecked());
    open.page.process().step(250);
    const auto reached = [&] { return open.page.world().scene().jointsOf(0, open.page.row()).at(joint) * 180 / M_PI; };
    QTRY_COMPARE_WITH_TIMEOUT(open.page.row().period, 250L, 10000);
    QVERIFY2(isNear(reached(), 30, 3), qPrintable(QString::number(reached())));
    QVERIFY(panel->findChild<QLabel*>("reached.HEAD_PAN")->text().endsWith("°"));
    open.picture("joints");
    hold->click();
    QVERIFY(!hold->isChecked());
    QVERIFY(open.page.world().held("dog").empty());
    open.page.process().end();
    const std::string log = readFile(open.page.log().toStdString());
    QVERIFY(log.find("\"act\":\"hold\"") != std::string::npos);
  }

  void arrowsPullWhatIsSelectedWhileItRuns() {
    OpenPage open;
    QVERIFY(open.isThere());
    LivePage& page = open.page;
    open.select("crate");
    open.action("livePlay")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(page.row().period > 5, 20000);
    for (int i = 0; i < 5; ++i) QTest::keyClick(&page.view(), Qt::Key_PageUp, Qt::ShiftModifier);
    QTRY_VERIFY(page.row().hands_n.contains("crate"));
    // The spring's bound.
    QVERIFY(page.row().hands_n.at("crate").norm() <= 20 + 1e-9);
    QVERIFY(page.findChild<QLabel*>("liveHand")->text().contains("20 N"));
    // Held up by a spring k it hangs m·g/k below: 0.2 kg, 100 N/m.
    const double target = page.world().pulls().at("crate").target_m[2];
    QTRY_VERIFY_WITH_TIMEOUT(isNear(placeOf(page, "crate").z(), target - 0.2 * 9.81 / 100, 1e-3), 20000);
    QTRY_VERIFY_WITH_TIMEOUT(isNear(page.row().hands_n.at("crate").norm(), 0.2 * 9.81, 0.05), 20000);
    open.picture("pull");
    QTest::keyClick(&page.view(), Qt::Key_Escape);
    QVERIFY(page.world().pulls().empty());
    QTRY_VERIFY(page.row().hands_n.empty());
    QTRY_VERIFY_WITH_TIMEOUT(placeOf(page, "crate").z() < 0.06, 20000);
  }

  void whatIsDroppedFromThePaletteStandsFree() {
    OpenPage open;
    QVERIFY(open.isThere());
    LiveView& view = open.page.view();
    auto* palette = open.page.findChild<ThingPalette*>();
    // A box, dropped onto the ball.
    const auto pixel = view.camera().project({0.1, 0, 0}, view.size());
    QVERIFY(pixel.has_value());
    QMimeData data;
    data.setData(thingMimeType, "1");
    QDragEnterEvent enter(pixel->toPoint(), Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&view, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop(*pixel, Qt::CopyAction, &data, Qt::LeftButton, {});
    QApplication::sendEvent(&view, &drop);
    QTRY_COMPARE(open.count(), std::size_t(4));
    QTRY_COMPARE(open.page.world().selected(), std::string("box"));
    QTRY_VERIFY(open.page.world().isReady());
    const Eigen::Vector3d box = placeOf(open.page, "box");
    QVERIFY(isNear(box.z(), 0.05, 1e-9));  // half of its height: it stands on the floor
    const double apart = (box - placeOf(open.page, "ball")).head<2>().norm();
    QVERIFY(apart >= 0.0425 + std::hypot(0.1, 0.1) / 2);
    QVERIFY(apart < 0.0425 + std::hypot(0.1, 0.1) / 2 + 0.1);
    // By keyboard.
    qobject_cast<QTabWidget*>(palette->parentWidget()->parentWidget())->setCurrentWidget(palette);
    open.picture("palette");
    palette->setCurrentRow(0);
    emit palette->itemActivated(palette->item(0));
    QTRY_COMPARE(open.page.world().selected(), std::string("ball2"));
  }

  void freePlacesAreTheNearestOnes() {
    Footprint wall;
    wall.half_m = {1, 0.05};
    wall.heading_rad = M_PI / 2;  // along y
    QVERIFY(isNear(wall.distanceTo({0.25, 0.5}), 0.2, 1e-12));
    QVERIFY(isNear(wall.distanceTo({0, 0}), -0.05, 1e-12));
    QVERIFY(isNear(wall.distanceTo({0.05 + 0.3, 1 + 0.4}), 0.5, 1e-12));
    const Eigen::Vector2d at = freePlace({wall}, {0.01, 0}, 0.1);
    QVERIFY(wall.distanceTo(at) >= 0.11);
    QVERIFY((at - Eigen::Vector2d(0.01, 0)).norm() < 0.16 + 0.02);
    QCOMPARE(freePlace({wall}, {3, 3}, 0.1), Eigen::Vector2d(3, 3));
  }

  void aStoredIndividualPlays() {
    StoredRun stored;
    ExperimentSpec spec = StoredRun::spec();
    spec.name = "Walk";
    spec.controller.name = "walk";
    RunRecord run;
    run.experiment =
        stored.database.addExperiment({.name = spec.name, .specJson = toJsonText(spec), .createdAt = "", .note = ""});
    run.seed = 1;
    run.specJson = toJsonText(spec);
    run.specSha256 = "walk";
    run.sceneJson = R"({"format": "uchilsim-scene-1"})";
    run.reality = "person";
    SimulatorRecord first;
    first.madeBy = "start";
    const Id id = stored.database.addRun(run, first);
    GenerationRecord generation;
    generation.run = id;
    generation.number = 1;
    generation.simulator = stored.database.simulators(id).back().id;
    generation.randomState = generation.learnerState = "{}";
    const std::vector<Parameter> genotype = plugins().controller("walk")->genotype();
    for (const double length : {0.05, 0.09}) {
      IndividualRecord individual;
      individual.generation = 1;
      individual.slot = length > 0.06;
      individual.simulator = generation.simulator;
      individual.chromosome = length > 0.06 ? "10" : "01";
      for (const Parameter& parameter : genotype)
        individual.parameters.push_back(parameter.name == "length_m" ? length : parameter.byDefault);
      individual.fitness = length;
      generation.individuals.push_back(individual);
    }
    stored.database.addGeneration(generation);

    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    OpenPage open;
    open.page.setDatabase(reader);
    QVERIFY(open.isThere());
    open.select("dog");
    open.page.findChild<QPushButton*>("liveStored")->click();
    auto* dialog = open.page.findChild<IndividualDialog*>();
    QVERIFY(dialog);
    auto* table = dialog->findChild<QTableWidget*>("individualTable");
    QTRY_COMPARE(table->rowCount(), 2);  // the best one first
    if (const QString wanted = qEnvironmentVariable("LIVE_PICTURES"); !wanted.isEmpty())
      dialog->grab().save(wanted + "/individual.png");
    dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->click();
    QTRY_COMPARE(toldGame(open.page).robots.at("dog").controller->parameters.at("length_m"), 0.09);
    QCOMPARE(open.page.game().robots.at("dog").controller->parameters.size(), genotype.size());
  }

  void theLastGameOpensAgain() {
    OpenPage open;
    QVERIFY(open.isThere());
    LivePage next(plugins(), BTR_PROGRAM, {});
    next.openWhenShown(open.file);
    QVERIFY(next.file().isEmpty());
    next.show();
    QTRY_VERIFY_WITH_TIMEOUT(!next.row().values.empty(), 20000);
    QCOMPARE(next.file(), open.file);
  }

  void theRefereesScoreIsShownWhereThereIsOne() {
    LiveTools tools;
    LiveRow row;
    tools.show();
    tools.showRow(row, 0);
    auto* score = tools.findChild<QLabel*>("liveScore");
    auto* kickOff = tools.findChild<QAction*>("liveKickOff");
    QVERIFY(!kickOff->isVisible());
    row.score = std::array<int, 2>{2, 1};
    row.clock_s = 512;
    tools.showRow(row, 0);
    QCOMPARE(score->text(), QString("red 2 : 1 blue · 8:32"));
    QVERIFY(kickOff->isVisible());
    row.events = {"goal of red"};
    tools.showRow(row, 0);
    row.events.clear();
    tools.showRow(row, 0);
    QCOMPARE(score->toolTip(), QString("Last: goal of red"));
  }

  void aMatchShowsItsScoreAndKicksOff() {
    LivePage page(plugins(), BTR_PROGRAM, {});
    page.show();
    page.open(SOURCE_DIR "/resources/games/match-2004.json");
    auto* score = page.findChild<QLabel*>("liveScore");
    QTRY_COMPARE_WITH_TIMEOUT(score->text(), QString("red 0 : 0 blue · 0:00"), 30000);
    page.findChild<QAction*>("liveKickOff")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(score->toolTip().contains("kick off"), 20000);
  }
};

UI_TEST(TestLiveDesk)
#include "test_live_desk.moc"

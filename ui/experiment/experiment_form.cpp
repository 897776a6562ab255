#include "ui/experiment/experiment_form.h"

#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <filesystem>
#include <set>

#include "core/spec/error.h"
#include "core/spec/file_kind.h"
#include "ui/common/look/section.h"
#include "ui/common/look/style_sheet.h"
#include "ui/common/look/tab_order.h"
#include "ui/common/look/theme.h"
#include "ui/experiment/learner_form.h"
#include "ui/experiment/parameter_form.h"
#include "ui/experiment/search_start.h"

namespace btr::ui {
namespace {

std::set<std::string> adaptedNames(const ExperimentSpec& spec) {
  std::set<std::string> names(spec.adapted.begin(), spec.adapted.end());
  if (names.empty())
    for (const Parameter& parameter : simulatorParameters()) names.insert(parameter.name);
  return names;
}

void checkSettings(const PluginChoice& choice, const std::vector<PluginForm::Offer>& offers, const std::string& place) {
  for (const auto& offer : offers)
    if (offer.name.toStdString() == choice.name)
      settingsOf(PluginForm::withoutPaths(choice, offer), offer.settings, place);
}

/// In the list of L2's learners: the run has no L2.
const char* const noLearner = "none";

std::vector<PluginForm::Offer> withNone(const std::vector<PluginForm::Offer>& offers) {
  std::vector<PluginForm::Offer> all{{noLearner, {}, QObject::tr("The run does not learn in reality.")}};
  all.insert(all.end(), offers.begin(), offers.end());
  return all;
}

std::map<QString, std::vector<PluginForm::Offer>> withNone(
    const std::map<QString, std::vector<PluginForm::Offer>>& all) {
  std::map<QString, std::vector<PluginForm::Offer>> with;
  for (const auto& [genotype, offers] : all) with[genotype] = withNone(offers);
  return with;
}

QString changes(int count) { return count == 0 ? QString() : QObject::tr("%1 changed").arg(count); }

}  // namespace

ExperimentOffers offersOf(const PluginHost& host) {
  ExperimentOffers offers;
  for (const auto& name : host.controllers()) {
    const auto controller = host.controller(name);
    offers.controllers.push_back({QString::fromStdString(name), controller->settings(), {}, controller->paths()});
    offers.startsOf[QString::fromStdString(name)] = startOffers(controller->genotype());
  }
  for (const auto& name : host.fitnesses()) {
    const auto fitness = host.fitness(name);
    offers.fitnesses.push_back({QString::fromStdString(name), fitness->settings(),
                                QString::fromStdString(fitness->meaning() + " [" + fitness->unit() + "]")});
  }
  for (const auto& name : host.learners()) {
    const auto learner = host.learner(name);
    const QString shown = QString::fromStdString(name);
    offers.learners.push_back({shown, learner->settings(), {}});
    offers.adapters.push_back({shown, learner->settingsFor(simulatorParameters()), {}});
    for (const auto& controller : host.controllers())
      offers.learnersOf[QString::fromStdString(controller)].push_back(
          {shown, learner->settingsFor(host.controller(controller)->genotype()), {}});
  }
  offers.genotypeOf = [&host](const std::string& controller, const std::map<std::string, std::string>& paths) {
    return host.controller(controller)->with(paths)->genotype();
  };
  offers.learnersFor = [&host](const std::vector<Parameter>& genotype) {
    std::vector<PluginForm::Offer> learners;
    for (const auto& name : host.learners())
      learners.push_back({QString::fromStdString(name), host.learner(name)->settingsFor(genotype), {}});
    return learners;
  };
  for (const auto& name : host.realities()) {
    const auto reality = host.reality(name);
    offers.realities.push_back({QString::fromStdString(name), QString::fromStdString(reality->meaning()),
                                reality->settings(), reality->texts()});
  }
  return offers;
}

ExperimentForm::ExperimentForm(const ExperimentOffers& offers, QWidget* parent)
    : QWidget(parent),
      offers_(offers),
      controller_(new PluginForm(tr("Controller"), offers.controllers, undo_, this)),
      fitness_(new PluginForm(tr("Fitness"), offers.fitnesses, undo_, this)),
      adaptation_(
          new PluginForm(tr("Learner"), offers.adapters.empty() ? offers.learners : offers.adapters, undo_, this)),
      learner_(new LearnerForm(tr("Learner"), offers.learnersOf, offers.learners, undo_, this)),
      realityLearner_(
          new LearnerForm(tr("Learner"), withNone(offers.learnersOf), withNone(offers.learners), undo_, this)),
      searchStart_(new LearnerForm(tr("Search begins"), offers.startsOf, startOffers({}), undo_, this)),
      stages_(new ParameterForm(stageParameters(), undo_, this)),
      realitySettings_(new ParameterForm(realityLearningParameters(), undo_, this)),
      adaptationSettings_(new ParameterForm(adaptationParameters(), undo_, this)),
      simulator_(new ParameterForm(simulatorParameters(), undo_, {.checkable = true, .filterFrom = 99}, this)) {
  controller_->setObjectName("controller");
  fitness_->setObjectName("fitness");
  learner_->setObjectName("learner");
  adaptation_->setObjectName("adaptation");
  realityLearner_->setObjectName("realityLearner");
  searchStart_->setObjectName("searchStart");
  realitySettings_->setObjectName("realitySettings");
  stages_->setObjectName("stages");
  simulator_->setObjectName("simulator");

  auto* simulatorPart = new QWidget(this);
  auto* simulatorColumn = new QVBoxLayout(simulatorPart);
  simulatorColumn->setContentsMargins(0, 0, 0, 0);
  auto* hint =
      new QLabel(tr("The value that the first simulator starts with; a tick lets L3 change it."), simulatorPart);
  hint->setWordWrap(true);
  hint->setContentsMargins(8, 2, 8, 2);
  effects_ = new QLabel(simulatorPart);
  effects_->setWordWrap(true);
  effects_->setContentsMargins(8, 2, 8, 2);
  simulatorColumn->addWidget(hint);
  simulatorColumn->addWidget(simulator_);
  simulatorColumn->addWidget(effects_);

  auto* adaptationPart = new QWidget(this);
  auto* adaptationColumn = new QVBoxLayout(adaptationPart);
  adaptationColumn->setContentsMargins(0, 0, 0, 0);
  adaptationColumn->addWidget(adaptationSettings_);
  adaptationColumn->addWidget(adaptation_);

  // The story of a run from top to bottom: what, how it is judged, L1, measuring, L2, L3.
  auto* inside = inside_ = new QWidget;
  auto* column = new QVBoxLayout(inside);
  column->setContentsMargins(6, 4, 6, 4);
  add(*column, tr("Experiment"), makeGeneral(), true);
  add(*column, tr("Task"), controller_, true);
  add(*column, tr("Fitness"), fitness_, true);
  add(*column, tr("L1 · learning in simulation"), learner_, true);
  add(*column, tr("Start of the search"), searchStart_, false);
  add(*column, tr("Stages and measuring"), stages_, true);
  add(*column, tr("Reality"), makeReality(), true);
  add(*column, tr("L2 · learning in reality"), makeRealityLearning(), false);
  add(*column, tr("L3 · adapting the simulator"), adaptationPart, false);
  add(*column, tr("Simulator parameters"), simulatorPart, false);
  recordingsSection_ = add(*column, tr("Recordings and gap analysis"), makeRecordings(), false);
  column->addStretch();

  auto* scroll = new QScrollArea(this);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAsNeeded);
  scroll->setWidget(inside);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(scroll, 1);
  makeBars(*all);

  connect(controller_, &PluginForm::changed, this, &ExperimentForm::followController);
  for (auto* form : findChildren<ParameterForm*>())
    connect(form, &ParameterForm::changed, this, &ExperimentForm::update);
  for (auto* form : {controller_, fitness_, adaptation_})
    connect(form, &PluginForm::changed, this, &ExperimentForm::update);
  for (auto* form : {learner_, realityLearner_, searchStart_})
    connect(form, &LearnerForm::changed, this, &ExperimentForm::update);
  setSpec({});
  orderTabs(*inside_);
}

// The stack's commands point into this form: it must be empty before the widgets go.
ExperimentForm::~ExperimentForm() { undo_.clear(); }

void ExperimentForm::setOffers(const ExperimentOffers& offers) {
  offers_ = offers;
  controller_->addOffers(offers.controllers);
  fitness_->addOffers(offers.fitnesses);
  adaptation_->addOffers(offers.adapters.empty() ? offers.learners : offers.adapters);
  learner_->setOffers(offers.learnersOf, offers.learners);
  realityLearner_->setOffers(withNone(offers.learnersOf), withNone(offers.learners));
  searchStart_->setOffers(offers.startsOf, startOffers({}));
  realityForm_->addOffers(offers.realities);
  offerRealities();
  if (readOnly_) setReadOnly(why_->text());
  orderTabs(*inside_);
}

void ExperimentForm::offerRealities() {
  for (const RealityForm::Offer& offer : offers_.realities) {
    int index = reality_->findData(offer.name);
    if (index < 0) {
      index = reality_->count();
      reality_->addItem(offer.name, offer.name);
    } else if (offer.name != "person" && offer.name != "stand_in") {
      reality_->setItemText(index, offer.name);  // may have been "not installed"
    }
    if (index > 1) reality_->setItemData(index, offer.meaning, Qt::ToolTipRole);
  }
}

void ExperimentForm::setSpec(const ExperimentSpec& spec) {
  checkSettings(spec.controller, offers_.controllers, "controller/settings");
  checkSettings(spec.fitness, offers_.fitnesses, "fitness/settings");
  const QString controller = genotypeFor(spec.controller, spec);
  const auto& learners = learner_->offersFor(controller);
  checkSettings(spec.learner, learners, "learner/settings");
  checkSettings(spec.realityLearner, learners, "reality_learning/learner/settings");
  checkSettings(spec.adaptation, offers_.adapters.empty() ? offers_.learners : offers_.adapters,
                "adaptation/learner/settings");
  checkSettings(choiceOf(spec.start), searchStart_->offersFor(controller), "start");
  {
    const QScopedValueRollback filling(filling_, true);
    fill(spec);
  }
  undo_.clear();
  update();
}

void ExperimentForm::fill(const ExperimentSpec& spec) {
  shown_ = spec;
  sceneRead_.clear();
  name_->setText(QString::fromStdString(spec.name));
  scene_->setText(QString::fromStdString(spec.scene));
  for (QLineEdit* edit : {name_, scene_}) edit->setCursorPosition(0);  // a long text is seen from its beginning
  seed_->setValues({{"seed", double(spec.seed)}});
  controller_->setChoice(spec.controller);
  fitness_->setChoice(spec.fitness);
  followController();
  learner_->setChoice(spec.learner);
  searchStart_->setChoice(choiceOf(spec.start));
  realityLearner_->setChoice(spec.realityLearner.name.empty() ? PluginChoice{noLearner, {}, {}} : spec.realityLearner);
  realitySettings_->setValues(spec.realitySettings);
  stages_->setValues(spec.stages);
  adaptation_->setChoice(spec.adaptation);
  adaptationSettings_->setValues(spec.adaptationSettings);
  simulator_->setValues(spec.simulator.values);
  simulator_->setChecked(adaptedNames(spec));
  const QString reality = QString::fromStdString(spec.reality);
  realityForm_->setOptions(reality, spec.realityOptions);
  if (reality_->findData(reality) < 0) reality_->addItem(tr("%1 (not installed)").arg(reality), reality);
  chosenReality_ = reality_->findData(reality);
  reality_->setCurrentIndex(chosenReality_);
  standIn_->setValues(spec.standIn);
  recordings_->setValues(spec.recordings.settings);
  const auto list = [](const std::vector<std::string>& names, const QString& none) {
    QStringList words;
    for (const std::string& name : names) words << QString::fromStdString(name);
    return words.isEmpty() ? none : words.join(", ");
  };
  concealed_->setText(tr("Its hidden effects are drawn from: %1; at: %2")
                          .arg(list(spec.concealed.effects, tr("all")), list(spec.concealed.at, tr("anywhere"))));
  recorded_->setText(tr("Joints compared: %1. Fitted: %2. Effects considered: %3.")
                         .arg(list(spec.recordings.joints, tr("all")),
                              list(spec.recordings.calibrate, tr("p, d and largest torque of the servos")),
                              list(spec.recordings.effects, tr("all that can act"))) +
                     (spec.recordings.poses().size() < 2
                          ? QString()
                          : tr(" On the floor then, fitted: %1. Effects considered: %2.")
                                .arg(list(spec.recordings.calibrateOnFloor, tr("friction and slip")),
                                     list(spec.recordings.effectsOnFloor, tr("all that do not act on joints")))));

  QStringList effects;
  for (const auto& effect : spec.simulator.effects)
    effects << QString::fromStdString(effect.effect + " at " + effect.at);
  effects_->setText(tr("Added effects: %1").arg(effects.join(", ")));
  effects_->setVisible(!effects.isEmpty());
}

QString ExperimentForm::genotypeFor(const PluginChoice& controller, const ExperimentSpec& spec) {
  QString name = QString::fromStdString(controller.name);
  const auto offer = std::ranges::find(offers_.controllers, name, &PluginForm::Offer::name);
  if (offer == offers_.controllers.end() || offer->paths.empty() || !offers_.genotypeOf) return name;
  std::vector<Parameter> genotype;
  try {
    std::map<std::string, std::string> paths;
    for (const std::string& path : offer->paths) {
      const auto given = controller.words.find(path);
      if (given == controller.words.end() || given->second.empty()) throw InputError("a path is missing");
      paths[path] = (std::filesystem::path(spec.directory) / given->second).lexically_normal().string();
    }
    genotype = offers_.genotypeOf(controller.name, paths);
  } catch (const InputError&) {
    // Whoever starts the run is told what is wrong with the file; until then the form shows what the experiment says.
    if (!spec.start) return name;
    constexpr double most = 1e12;
    for (const auto& [parameter, value] : spec.start->parameters)
      genotype.push_back({parameter, "", "", -most, most, value});
  }
  for (const Parameter& p : genotype)
    name += QStringLiteral("\n%1 %2 %3 %4 %5")
                .arg(QString::fromStdString(p.name))
                .arg(p.minimum, 0, 'g', 17)
                .arg(p.maximum, 0, 'g', 17)
                .arg(p.byDefault, 0, 'g', 17)
                .arg(p.integer);
  if (!offers_.startsOf.contains(name)) {
    offers_.startsOf[name] = startOffers(genotype);
    offers_.learnersOf[name] = offers_.learnersFor ? offers_.learnersFor(genotype) : offers_.learners;
    learner_->setOffers(offers_.learnersOf, offers_.learners);
    realityLearner_->setOffers(withNone(offers_.learnersOf), withNone(offers_.learners));
    searchStart_->setOffers(offers_.startsOf, startOffers({}));
  }
  return name;
}

ExperimentSpec ExperimentForm::spec() const {
  ExperimentSpec spec = shown_;
  spec.name = name_->text().trimmed().toStdString();
  spec.scene = scene_->text().trimmed().toStdString();
  const Values seed = seed_->values();
  if (const auto value = seed.find("seed"); value != seed.end())
    spec.seed = static_cast<std::uint64_t>(value->second);
  else
    spec.seed = 1;
  spec.controller = controller_->choice();
  spec.fitness = fitness_->choice();
  spec.learner = learner_->choice();
  spec.start = startFrom(searchStart_->choice(), searchStart_->offersFor(genotype_));
  spec.realityLearner = realityLearner_->choice();
  if (spec.realityLearner.name == noLearner) spec.realityLearner = {};
  spec.realitySettings = spec.realityLearner.name.empty() ? Values{} : realitySettings_->values();
  spec.stages = stages_->values();
  spec.adaptation = adaptation_->choice();
  spec.adaptationSettings = adaptationSettings_->values();
  spec.simulator.values = simulator_->values();
  const QString reality = reality_->currentData().toString();
  spec.reality = reality.toStdString();
  spec.realityOptions = isOffered(reality) ? realityForm_->options(reality) : shown_.realityOptions;
  spec.standIn = standIn_->values();
  spec.recordings.settings = recordings_->values();
  // "All" may be written as nothing or as every name: what was read stays as it was.
  if (simulator_->checked() != adaptedNames(shown_)) {
    spec.adapted.clear();
    const std::set<std::string> checked = adapted();
    const auto isShown = [this](const Parameter& p) { return simulator_->shows(p.name); };
    if (static_cast<std::ptrdiff_t>(checked.size()) < std::ranges::count_if(simulatorParameters(), isShown))
      for (const Parameter& parameter : simulatorParameters())
        if (checked.count(parameter.name)) spec.adapted.push_back(parameter.name);
  }
  return spec;
}

std::map<QString, ParameterForm*> ExperimentForm::numbers() const {
  std::map<QString, ParameterForm*> all{{"seed", seed_},
                                        {"controller", controller_->numbers()},
                                        {"fitness", fitness_->numbers()},
                                        {"learner", learner_->numbers()},
                                        {"searchStart", searchStart_->numbers()},
                                        {"stages", stages_},
                                        {"realityLearner", realityLearner_->numbers()},
                                        {"realitySettings", realitySettings_},
                                        {"reality", realityForm_->numbers(reality_->currentData().toString())},
                                        {"standIn", standIn_},
                                        {"adaptation", adaptation_->numbers()},
                                        {"adaptationSettings", adaptationSettings_},
                                        {"simulator", simulator_},
                                        {"recordings", recordings_}};
  std::erase_if(all, [](const auto& each) { return !each.second; });
  return all;
}

QVariantMap ExperimentForm::refused() const {
  QVariantMap all;
  for (const auto& [name, form] : numbers()) {
    QVariantMap texts;
    for (const auto& [parameter, text] : form->refused()) texts[QString::fromStdString(parameter)] = text;
    if (!texts.isEmpty()) all[name] = texts;
  }
  return all;
}

void ExperimentForm::showRefused(const QVariantMap& texts) {
  for (const auto& [name, form] : numbers()) {
    std::map<std::string, QString> own;
    const QVariantMap typed = texts[name].toMap();
    for (const auto& [parameter, text] : typed.asKeyValueRange()) own[parameter.toStdString()] = text.toString();
    if (!own.empty()) form->setTexts(own);
  }
}

QStringList ExperimentForm::problems() const {
  QStringList problems;
  if (name_->text().trimmed().isEmpty()) problems << tr("Name: at least one letter");
  const QString scene = scene_->text().trimmed();
  const QDir folder(QString::fromStdString(shown_.directory));
  if (scene.isEmpty())
    problems << tr("Scene: the path of a scene file");
  else if (!readOnly_ && !QFileInfo(folder, scene).isFile())
    problems << tr("Scene: there is no such file: %1").arg(folder.absoluteFilePath(scene));
  else if (!readOnly_)
    try {
      requireKind(folder.absoluteFilePath(scene).toStdString(), FileKind::scene);
    } catch (const InputError& wrong) {
      problems << tr("Scene: %1").arg(QString::fromUtf8(wrong.what()));
    }
  problems << seed_->problems() << controller_->problems() << fitness_->problems() << learner_->problems()
           << searchStart_->problems() << stages_->problems();
  problems << realityLearner_->problems();
  if (realityLearner_->choice().name != noLearner) problems << realitySettings_->problems();
  const QString reality = reality_->currentData().toString();
  if (reality == "stand_in") problems << standIn_->problems();
  if (!isOffered(reality)) problems << tr("Measured by: %1 is not installed").arg(reality);
  problems << realityForm_->problems(reality);
  problems << adaptationSettings_->problems() << adaptation_->problems() << simulator_->problems()
           << recordings_->problems();
  if (adapted().empty()) problems << tr("Simulator parameters: tick at least one that L3 may change");
  if (problems.isEmpty()) {
    const double heldOut = valueOf(adaptationParameters(), adaptationSettings_->values(), "held_out");
    const double measured = valueOf(stageParameters(), stages_->values(), "measured_individuals");
    const double disagreeing = valueOf(stageParameters(), stages_->values(), "disagreeing_individuals");
    const double first = valueOf(stageParameters(), stages_->values(), "first_generations");
    if (valueOf(stageParameters(), stages_->values(), "total_generations") < first)
      problems << tr("Total generations: at least the %1 first generations").arg(first);
    if (disagreeing > measured)
      problems << tr("Disagreeing individuals: at most the %1 measured individuals").arg(measured);
    if (heldOut >= measured) problems << tr("Held out: less than the %1 measured individuals").arg(measured);
  }
  return problems;
}

bool ExperimentForm::isOffered(const QString& reality) const {
  return reality == "person" || reality == "stand_in" ||
         std::ranges::any_of(offers_.realities, [&](const RealityForm::Offer& offer) { return offer.name == reality; });
}

void ExperimentForm::setReadOnly(const QString& why) {
  readOnly_ = true;
  name_->setReadOnly(true);
  scene_->setReadOnly(true);
  browse_->hide();
  reality_->setEnabled(false);
  realityForm_->setReadOnly(true);
  for (auto* form : findChildren<ParameterForm*>()) form->setReadOnly(true);
  for (auto* form : {controller_, fitness_, adaptation_}) form->setReadOnly(true);
  for (auto* form : {learner_, realityLearner_, searchStart_}) form->setReadOnly(true);
  why_->setText(why);
  update();
}

void ExperimentForm::resetAll() {
  undo_.beginMacro(tr("reset all fields"));
  for (auto* form : {controller_, fitness_, adaptation_}) form->resetAll();
  for (auto* form : {learner_, realityLearner_, searchStart_}) form->resetAll();
  for (auto* form : {stages_, realitySettings_, adaptationSettings_, simulator_, standIn_, recordings_})
    form->resetAll();
  undo_.endMacro();
}

Section* ExperimentForm::add(QVBoxLayout& column, const QString& title, QWidget* content, bool open) {
  auto* section = new Section(title, content, this);
  section->setOpen(open);
  column.addWidget(section);
  sections_.push_back(section);
  return section;
}

// Everything that depends on the fields: which parts are seen, what is wrong, what may be pressed.
void ExperimentForm::update() {
  if (!problem_ || filling_) return;
  followScene();
  const bool standIn = reality_->currentData().toString() == "stand_in";
  realityForm_->show(reality_->currentData().toString());
  standIn_->setVisible(standIn);
  standInNote_->setVisible(standIn);
  concealed_->setVisible(standIn && shown_.concealed != ConcealedSpec{});
  const double after = valueOf(recordingParameters(), recordings_->values(), "after_stage");
  recorded_->setVisible(after > 0);
  recordingsSection_->setSummary(after > 0 ? tr("after stage %1").arg(after) : tr("none"));
  styleOnce(*standInNote_, QStringLiteral("color: %1; font-weight: 600").arg(tonesOf(palette()).standIn.name()));
  sections_[1]->setSummary(changes(controller_->changedCount()));
  sections_[2]->setSummary(changes(fitness_->changedCount()));
  sections_[3]->setSummary(changes(learner_->changedCount()));
  sections_[4]->setSummary(QString::fromStdString(searchStart_->choice().name));
  sections_[5]->setSummary(changes(stages_->changedCount()));
  const bool learnsInReality = realityLearner_->choice().name != noLearner;
  realitySettings_->setVisible(learnsInReality);
  sections_[7]->setSummary(learnsInReality ? QString::fromStdString(realityLearner_->choice().name) : tr("none"));
  sections_[8]->setSummary(changes(adaptationSettings_->changedCount() + adaptation_->changedCount()));
  sections_[9]->setSummary(tr("%1 of %2 adapted")
                               .arg(adapted().size())
                               .arg(std::ranges::count_if(simulatorParameters(), [this](const auto& p) {
                                 return simulator_->shows(p.name);
                               })));

  const QStringList wrong = readOnly_ ? QStringList() : problems();
  problem_->setText(wrong.isEmpty()
                        ? QString()
                        : wrong.first() + (wrong.size() > 1 ? tr(" (and %1 more)").arg(wrong.size() - 1) : QString()));
  styleOnce(*problem_, QStringLiteral("color: %1").arg(tonesOf(palette()).bad.name()));
  problem_->setVisible(!wrong.isEmpty());
  start_->setEnabled(wrong.isEmpty());
  save_->setEnabled(wrong.isEmpty());
  start_->setVisible(!readOnly_);
  editBar_->setVisible(!readOnly_);
  copy_->setVisible(readOnly_);
  why_->setVisible(!why_->text().isEmpty());
  emit changed();
}

}  // namespace btr::ui

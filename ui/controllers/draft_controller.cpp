#include "ui/controllers/draft_controller.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "core/spec/file_kind.h"
#include "core/spec/json_reader.h"
#include "ui/common/resources.h"
#include "ui/experiment/experiment_form.h"

namespace btr::ui {
namespace {
constexpr auto unsavedFlag = "draftUnsaved";
}

DraftController::DraftController(Workbench& bench, ExperimentForm& draft, ExperimentForm& spec)
    : QObject(&bench), bench_(bench), draft_(draft), spec_(spec) {
  connect(&draft_, &ExperimentForm::startRequested, this, &DraftController::start);
  connect(&draft_, &ExperimentForm::saveRequested, this, &DraftController::save);
  connect(&draft_, &ExperimentForm::openRequested, this, &DraftController::openWithDialog);
  connect(&draft_, &ExperimentForm::changed, this, [this] {
    if (!refused_.isEmpty() && !draft_.problems().contains(refused_)) bench_.mend(std::exchange(refused_, {}));
  });
  connect(&spec_, &ExperimentForm::copyRequested, this, &DraftController::copyStored);
  connect(&bench_.launcher(), &RunLauncher::stored, this, [this] {
    draft_.markSaved();
    keptUnsaved_ = false;
  });
}

bool DraftController::isUnsaved() const { return draft_.isModified() || keptUnsaved_; }

bool DraftController::mayReplace() {
  if (!isUnsaved()) return true;
  emit bench_.dockWanted("draft");
  QMessageBox box(bench_.window());
  box.setObjectName("replaceDraft");
  box.setIcon(QMessageBox::Question);
  box.setWindowTitle(tr("The experiment is not saved"));
  box.setTextFormat(Qt::PlainText);
  box.setText(tr("“%1” in the form has changes that are not saved.").arg(QString::fromStdString(draft_.spec().name)));
  box.setInformativeText(tr("If it is replaced, the changes are lost."));
  auto* save = box.addButton(tr("Save…"), QMessageBox::AcceptRole);
  auto* replace = box.addButton(tr("Replace it"), QMessageBox::DestructiveRole);
  auto* cancel = box.addButton(QMessageBox::Cancel);
  save->setObjectName("save");
  replace->setObjectName("replace");
  cancel->setObjectName("cancel");
  box.setDefaultButton(save);
  box.setEscapeButton(cancel);
  box.exec();
  if (box.clickedButton() == save) return this->save();
  return box.clickedButton() == replace;
}

void DraftController::show(const ExperimentSpec& spec) {
  offerPluginsOf(spec);
  draft_.setSpec(spec);
  keptUnsaved_ = false;
}

// An experiment may name folders of plugins.
void DraftController::offerPluginsOf(const ExperimentSpec& spec) {
  if (spec.plugins.empty()) return;
  bench_.host()->load(pluginFolders(spec), "experiment /plugins");
  draft_.setOffers(offersOf(*bench_.host()));
}

bool DraftController::begin() {
  if (!mayReplace() || !fresh()) return false;
  emit bench_.dockWanted("draft");
  draft_.focusFirst();
  return true;
}

bool DraftController::fresh() {
  return bench_.guard([this] {
    const PluginHost& host = *bench_.host();
    ExperimentSpec spec;
    spec.name = tr("Experiment").toStdString();
    spec.directory = (resourceDirectory() + "/experiments").toStdString();
    const auto best = [](const std::vector<std::string>& names, const char* wanted) {
      if (std::ranges::find(names, wanted) != names.end()) return std::string(wanted);
      return names.empty() ? std::string() : names.front();
    };
    spec.controller.name = best(host.controllers(), "kick");
    spec.fitness.name = best(host.fitnesses(), "kick_distance");
    spec.learner.name = spec.adaptation.name = best(host.learners(), "ga");
    if (QFileInfo::exists(resourceDirectory() + "/scenes/kick.json")) spec.scene = "../scenes/kick.json";
    show(spec);
  });
}

bool DraftController::open(const QString& file) {
  ExperimentSpec spec;
  const bool read = bench_.guard([&] {
    const std::string path = QFileInfo(file).absoluteFilePath().toStdString();
    requireKind(path, FileKind::experiment);
    spec = loadExperiment(path);
    offerPluginsOf(spec);
  });
  if (!read) refusedFile_ = bench_.lastError();
  if (!read || !mayReplace()) return false;
  return bench_.guard([&] {
    show(spec);
    bench_.mend(std::exchange(refusedFile_, {}));
    emit bench_.dockWanted("draft");
    bench_.inform(tr("Opened %1").arg(file));
  });
}

void DraftController::openWithDialog() {
  const QString file = QFileDialog::getOpenFileName(bench_.window(), tr("Open an experiment"),
                                                    QString::fromStdString(draft_.spec().directory),
                                                    tr("Experiments (*.json);;All files (*)"));
  if (!file.isEmpty()) open(file);
}

// Paths in the file are relative to it: the scene's path is written anew for the file's folder.
bool DraftController::save() {
  ExperimentSpec spec = draft_.spec();
  const QDir old(QString::fromStdString(spec.directory));
  QString file = QFileDialog::getSaveFileName(bench_.window(), tr("Save the experiment"),
                                              old.filePath(QString::fromStdString(spec.name) + ".json"),
                                              tr("Experiments (*.json)"));
  if (file.isEmpty()) return false;
  if (QFileInfo(file).suffix().isEmpty()) file += ".json";
  return bench_.guard([&] {
    const QDir folder = QFileInfo(file).absoluteDir();
    if (!spec.directory.empty() && QDir::isRelativePath(QString::fromStdString(spec.scene)))
      spec.scene = folder.relativeFilePath(old.absoluteFilePath(QString::fromStdString(spec.scene))).toStdString();
    for (std::string& plugins : spec.plugins)
      if (!spec.directory.empty() && QDir::isRelativePath(QString::fromStdString(plugins)))
        plugins = folder.relativeFilePath(old.absoluteFilePath(QString::fromStdString(plugins))).toStdString();
    spec.directory = folder.absolutePath().toStdString();
    writeFile(file.toStdString(), btr::toJsonText(spec));
    show(spec);
    bench_.inform(tr("Saved %1").arg(file));
  });
}

// A stored run's paths start from a folder that may be gone: the form says so when the run is started.
bool DraftController::copyStored() {
  if (!mayReplace()) return false;
  return bench_.guard([this] {
    ExperimentSpec spec = spec_.spec();
    if (spec.directory.empty()) spec.directory = (resourceDirectory() + "/experiments").toStdString();
    show(spec);
    emit bench_.dockWanted("draft");
  });
}

void DraftController::start() {
  if (!bench_.watcher().isOpen())
    return bench_.report(tr("Open or make a database first: a run is stored from its first generation on."));
  if (!draft_.isValid()) {
    emit bench_.dockWanted("draft");
    refused_ = draft_.problems().first();
    return bench_.report(refused_);
  }
  const ExperimentSpec spec = draft_.spec();
  bench_.inform(tr("Preparing %1 …").arg(QString::fromStdString(spec.name)));
  bench_.launcher().store(bench_.path(), spec, spec.seed, false);
}

bool DraftController::mayForget(const QString& why) {
  if (!isUnsaved()) return true;
  emit bench_.dockWanted("draft");
  QMessageBox box(bench_.window());
  box.setObjectName("forgetDraft");
  box.setIcon(QMessageBox::Warning);
  box.setWindowTitle(tr("The experiment cannot be kept"));
  box.setTextFormat(Qt::PlainText);
  box.setText(tr("The experiment in the form cannot be kept for the next start: %1").arg(why));
  box.setInformativeText(tr("If the window is closed, the changes are lost."));
  auto* close = box.addButton(tr("Close"), QMessageBox::DestructiveRole);
  auto* cancel = box.addButton(QMessageBox::Cancel);
  close->setObjectName("close");
  cancel->setObjectName("cancel");
  box.setDefaultButton(cancel);
  box.setEscapeButton(cancel);
  box.exec();
  return box.clickedButton() == close;
}

bool DraftController::keep() {
  const ExperimentSpec spec = draft_.spec();
  const std::string json = btr::toJsonText(spec);
  try {
    experimentFromJson(json, "draft", spec.directory);
  } catch (const std::exception& error) {
    return mayForget(QString::fromUtf8(error.what()));
  }
  bench_.settings().setDraft(QString::fromStdString(json), QString::fromStdString(spec.directory));
  bench_.settings().setDraftRefused(draft_.refused());
  bench_.settings().setFlag(unsavedFlag, isUnsaved());
  return true;
}

void DraftController::restore() {
  Settings& settings = bench_.settings();
  try {
    if (const QString json = settings.draft(); !json.isEmpty()) {
      show(experimentFromJson(json.toStdString(), "draft", settings.draftFolder().toStdString()));
      draft_.showRefused(settings.draftRefused());
      keptUnsaved_ = settings.flag(unsavedFlag, false);
      return;
    }
    for (const QString& path : exampleExperiments())
      if (QFileInfo(path).completeBaseName() == "kick-short") return show(loadExperiment(path.toStdString()));
  } catch (const std::exception&) {
    // A draft that no longer fits the installed plugins is let go: nothing was started from it.
  }
  fresh();
}

}  // namespace btr::ui

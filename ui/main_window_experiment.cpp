// The experiment that is being described: from files, into files, kept between two starts.
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <algorithm>

#include "core/spec/json_reader.h"
#include "ui/common/resources.h"
#include "ui/experiment/experiment_form.h"
#include "ui/main_window.h"

namespace btr::ui {

void MainWindow::newExperiment() {
  guard([this] {
    ExperimentSpec spec;
    spec.name = tr("Experiment").toStdString();
    spec.directory = (resourceDirectory() + "/experiments").toStdString();
    const auto best = [](const std::vector<std::string>& names, const char* wanted) {
      if (std::ranges::find(names, wanted) != names.end()) return std::string(wanted);
      return names.empty() ? std::string() : names.front();
    };
    spec.controller.name = best(host_->controllers(), "kick");
    spec.fitness.name = best(host_->fitnesses(), "kick_distance");
    spec.learner.name = spec.adaptation.name = best(host_->learners(), "ga");
    if (QFileInfo::exists(resourceDirectory() + "/scenes/kick.json")) spec.scene = "../scenes/kick.json";
    draft_->setSpec(spec);
    layout_.raise("draft");
  });
}

bool MainWindow::openExperiment(const QString& file) {
  return guard([&] {
    draft_->setSpec(loadExperiment(QFileInfo(file).absoluteFilePath().toStdString()));
    layout_.raise("draft");
    inform(tr("Opened %1").arg(file));
  });
}

void MainWindow::openExperimentWithDialog() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open an experiment"), QString::fromStdString(draft_->spec().directory),
                                   tr("Experiments (*.json);;All files (*)"));
  if (!file.isEmpty()) openExperiment(file);
}

// Paths in the file are relative to it: the scene's path is written anew for the file's folder.
void MainWindow::saveExperiment() {
  ExperimentSpec spec = draft_->spec();
  const QDir old(QString::fromStdString(spec.directory));
  QString file = QFileDialog::getSaveFileName(this, tr("Save the experiment"),
                                              old.filePath(QString::fromStdString(spec.name) + ".json"),
                                              tr("Experiments (*.json)"));
  if (file.isEmpty()) return;
  if (QFileInfo(file).suffix().isEmpty()) file += ".json";
  guard([&] {
    const QDir folder = QFileInfo(file).absoluteDir();
    if (!spec.directory.empty() && QDir::isRelativePath(QString::fromStdString(spec.scene)))
      spec.scene = folder.relativeFilePath(old.absoluteFilePath(QString::fromStdString(spec.scene))).toStdString();
    for (std::string& plugins : spec.plugins)
      if (!spec.directory.empty() && QDir::isRelativePath(QString::fromStdString(plugins)))
        plugins = folder.relativeFilePath(old.absoluteFilePath(QString::fromStdString(plugins))).toStdString();
    spec.directory = folder.absolutePath().toStdString();
    writeFile(file.toStdString(), btr::toJsonText(spec));
    draft_->setSpec(spec);
    inform(tr("Saved %1").arg(file));
  });
}

// A stored run's paths start from a folder that may be gone: the form says so when the run is started.
void MainWindow::copyToDraft() {
  guard([this] {
    ExperimentSpec spec = spec_->spec();
    if (spec.directory.empty()) spec.directory = (resourceDirectory() + "/experiments").toStdString();
    draft_->setSpec(spec);
    layout_.raise("draft");
  });
}

// Unfinished ones, too, as far as they can be read again.
void MainWindow::keepDraft() {
  const ExperimentSpec spec = draft_->spec();
  const std::string json = btr::toJsonText(spec);
  try {
    experimentFromJson(json, "draft", spec.directory);
  } catch (const std::exception&) {
    return;
  }
  settings_.setDraft(QString::fromStdString(json), QString::fromStdString(spec.directory));
}

// The draft of last time; on the first start an example, so that a newcomer has something to press Start on.
void MainWindow::restoreDraft() {
  try {
    if (const QString json = settings_.draft(); !json.isEmpty())
      return draft_->setSpec(experimentFromJson(json.toStdString(), "draft", settings_.draftFolder().toStdString()));
    for (const QString& path : exampleExperiments())
      if (QFileInfo(path).completeBaseName() == "kick-short")
        return draft_->setSpec(loadExperiment(path.toStdString()));
  } catch (const std::exception&) {
    // A draft that no longer fits the installed plugins is let go: nothing was started from it.
  }
  newExperiment();
}

}  // namespace btr::ui

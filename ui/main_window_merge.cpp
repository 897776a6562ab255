// Runs of another database: copied by a process beside the window, into the database that is open.
#include <QFileDialog>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>

#include "ui/common/message_banner.h"
#include "ui/gap/program_process.h"
#include "ui/main_window.h"

namespace btr::ui {

void MainWindow::connectMerge() {
  merging_ = new ProgramProcess(launcher_.program(), this);
  connect(merging_, &ProgramProcess::failed, this, &MainWindow::report);
  connect(merging_, &ProgramProcess::done, this, [this](const QByteArray& output) {
    const QJsonObject copied = QJsonDocument::fromJson(output).object();
    banner_->showMessage(MessageBanner::Kind::information, tr("%1 runs with %2 individuals were copied from %3.")
                                                               .arg(copied["runs"].toInt())
                                                               .arg(copied["individuals"].toInt())
                                                               .arg(QFileInfo(mergedFrom_).fileName()));
  });
}

void MainWindow::mergeWithDialog() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Add the runs of another database"), databasePath(),
                                                    tr("Experiment databases (*.db);;All files (*)"));
  if (!path.isEmpty()) mergeDatabase(path);
}

void MainWindow::backUpWithDialog() {
  const QString path = QFileDialog::getSaveFileName(this, tr("Back up the database"), databasePath() + ".backup.db",
                                                    tr("Experiment databases (*.db)"));
  if (!path.isEmpty()) launcher_.backUp(databasePath(), QFileInfo(path).suffix().isEmpty() ? path + ".db" : path);
}

void MainWindow::mergeDatabase(const QString& from) {
  if (!watcher_.isOpen()) return report(tr("No database is open that could take the runs: open or make one first"));
  if (merging_->isRunning()) return report(tr("Runs of %1 are still being copied").arg(mergedFrom_));
  mergedFrom_ = from;
  merging_->start({"--json", "merge", from, "--db", databasePath()});
}

}  // namespace btr::ui

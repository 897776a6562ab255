#include "ui/common/file_choice.h"

#include <QFileDialog>
#include <QFileSystemModel>
#include <QSortFilterProxyModel>

namespace btr::ui {
namespace {

class OfKind final : public QSortFilterProxyModel {
 public:
  OfKind(FileKind kind, QObject* parent) : QSortFilterProxyModel(parent), kind_(kind) {}

 protected:
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override {
    const auto* files = qobject_cast<const QFileSystemModel*>(sourceModel());
    const QModelIndex index = files->index(row, 0, parent);
    return files->isDir(index) || kindOfFile(files->filePath(index).toStdString()) == kind_;
  }

 private:
  FileKind kind_;
};

}  // namespace

std::unique_ptr<QFileDialog> fileDialog(QWidget* parent, const QString& title, const QString& folder, FileKind kind) {
  auto dialog = std::make_unique<QFileDialog>(parent, title, folder);
  // The desktop's own dialog cannot look into files.
  dialog->setOption(QFileDialog::DontUseNativeDialog);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setProxyModel(new OfKind(kind, dialog.get()));
  return dialog;
}

QString chooseFile(QWidget* parent, const QString& title, const QString& folder, FileKind kind) {
  const auto dialog = fileDialog(parent, title, folder, kind);
  return dialog->exec() == QDialog::Accepted ? dialog->selectedFiles().value(0) : QString();
}

}  // namespace btr::ui

#pragma once
#include <QString>
#include <memory>

#include "core/spec/file_kind.h"

class QFileDialog;
class QWidget;

namespace btr::ui {

/// A dialog that lists the folders and, of the files, those that are of that kind by their content.
std::unique_ptr<QFileDialog> fileDialog(QWidget* parent, const QString& title, const QString& folder, FileKind kind);

/// The chosen file; empty if the user chose none.
QString chooseFile(QWidget* parent, const QString& title, const QString& folder, FileKind kind);

}  // namespace btr::ui

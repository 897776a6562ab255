#pragma once
#include <QDialog>
#include <QUndoStack>
#include <array>
#include <functional>

#include "core/spec/grid_spec.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace btr::ui {
class ParameterForm;

/// A grid of experiments as a form: file in, file out. Angles stand in degrees; those that nobody touches keep the
/// numbers of their file.
class GridForm : public QDialog {
  Q_OBJECT
 public:
  explicit GridForm(QWidget* parent = nullptr);

  /// Shows a grid file. Throws InputError, with nothing changed.
  void openFile(const QString& path);
  /// Writes the grid there; the path of its experiment follows. Throws InputError.
  void saveFile(const QString& path);
  /// Who knows what an experiment's controller allows on each axis (axisParameters()); nothing is checked without.
  using Bounds = std::function<std::vector<Parameter>(const GridSpec&)>;
  void setBounds(Bounds bounds);
  QString file() const { return file_; }
  GridSpec spec() const;
  QString problem() const;  ///< empty if it can be started
  bool isModified() const;
  /// The whole file as it can be read from any folder.
  std::string portableText() const;

 signals:
  void startRequested();

 private:
  struct Axis {
    QLineEdit* edit = nullptr;
    QString shown;  ///< what the file's numbers look like
    std::vector<double> values;
  };
  QWidget* makeFileBar();
  QLayout* makeButtons();
  void chooseFile();
  void chooseExperiment();
  void chooseTarget();
  void tryTo(const std::function<void()>& action);
  std::string experimentPath() const;
  void refresh();

  QString outOfBounds() const;

  Bounds bounds_;
  QUndoStack undo_;
  GridSpec loaded_;
  QString file_;
  QLineEdit *name_, *experiment_, *seeds_;
  std::array<Axis, 3> axes_;
  QCheckBox* mirrored_;
  std::array<QCheckBox*, 3> methods_;
  ParameterForm* settings_;
  QLabel *fileLabel_, *summary_, *problem_;
  QPushButton *start_, *save_;
};

}  // namespace btr::ui

#pragma once
#include <QWidget>
#include <map>
#include <vector>

#include "core/store/records.h"

class QCheckBox;
class QLabel;
class QVBoxLayout;

namespace btr::ui {

/// What the window opens with when nothing waits to be gone on with: three doors. It asks by signals and does nothing
/// itself.
class StartPage : public QWidget {
  Q_OBJECT
 public:
  explicit StartPage(QWidget* parent = nullptr);
  /// The runs of the open database; the newest finished ones are offered.
  void setRuns(const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs);
  void setShownAtStart(bool shown);
  /// Whether a run waits for somebody to go on with it, or is at work.
  static bool isSomethingOpen(const std::vector<RunRecord>& runs);

 signals:
  void runWanted(btr::Id run);
  void databaseWanted(const QString& file);  ///< empty: the user chooses
  void newWanted();
  void exampleWanted(const QString& file);
  void analysisWanted();
  void reportWanted();
  void shownAtStartChanged(bool shown);

 protected:
  /// Pictures of a light window are not seen on a dark one.
  void changeEvent(QEvent* event) override;

 private:
  QVBoxLayout* addDoor(const QString& name, const QString& icon, const QString& title, const QString& text);

  std::map<QLabel*, QString> pictures_;  ///< with the icon's name
  QVBoxLayout* finished_;
  std::vector<Id> offered_;
  QCheckBox* atStart_;
};

}  // namespace btr::ui

#pragma once
#include <QWidget>
#include <vector>

#include "core/run/reality/reality_report.h"

class QComboBox;
class QLabel;
class QPushButton;
class QTabWidget;
class QTableWidget;

namespace btr::ui {

/// The page of L2: one iteration at a time, for each parameter the mean fitness of the policies below, at and above the
/// centre with standard errors, the step that was chosen and whether chance alone would explain it; and the policies
/// themselves. What the simulator promised of them is shown once they are measured.
class PolicyPage : public QWidget {
  Q_OBJECT
 public:
  explicit PolicyPage(QWidget* parent = nullptr);

  void setUnit(const QString& unit);
  /// The newest iteration is shown, unless the user looks at an earlier one that is still there.
  void setReports(std::vector<RealityReport> reports);
  const std::vector<RealityReport>& reports() const { return reports_; }
  /// Whether L2 waits for a person in the stage shown, so that it may be ended.
  void setWaiting(bool waits);

  enum StepColumn { parameter, step, verdict, pValue, below, same, above, before, after, stepColumns };
  enum PolicyColumn { individual, changes, simulated, real, values, policyColumns };

 signals:
  void replayRequested(btr::Id individual);
  void endRequested();  ///< a person has confirmed that L2 of this stage shall end now

 private:
  void confirmEnd();
  void showReport(int index);
  void showSteps(const RealityReport& report);
  void showPolicies(const RealityReport& report);

  QString unit_;
  std::vector<RealityReport> reports_;
  QComboBox* iteration_;
  QLabel* sentence_;
  QPushButton* end_;
  QTabWidget* tables_;
  QTableWidget *steps_, *policies_;
};

/// What an iteration found, in one sentence.
QString sentenceOf(const RealityReport& report);

}  // namespace btr::ui

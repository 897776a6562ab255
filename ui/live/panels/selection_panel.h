#pragma once
#include <QWidget>
#include <optional>
#include <string>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;

namespace btr::ui {
class DatabaseReader;
class LiveWorld;
class ParameterSets;
class SliderForm;

/// What is selected: where it is, to be put elsewhere by numbers; thrown; a robot's controller and its parameters,
/// which change while it runs.
class SelectionPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SelectionPanel(LiveWorld& world, QWidget* parent = nullptr);

  /// Everything anew.
  void showSelected();
  /// Where it is now; numbers that are being typed stay.
  void showPlace();
  /// Parameters only: somebody changed them.
  void showParameters();
  /// Where stored individuals come from; null: nowhere.
  void setDatabase(DatabaseReader* reader);
  ParameterSets& sets() { return *sets_; }

 signals:
  void problem(const QString& why);

 private:
  QWidget* makePlace();
  QWidget* makeThrow();
  QWidget* makePlayer();
  void showController();
  void placeAsTyped();
  void throwSelected();
  void changeController();
  void chooseStored();
  QWidget* makeStick();
  void showStick();
  void putIn(const QString& folder);
  void tune(const std::string& name, std::optional<double> value);

  LiveWorld& world_;
  QLabel *what_, *hand_;
  QWidget *place_, *throw_, *player_;
  QDoubleSpinBox *x_, *y_, *z_, *heading_, *speed_, *direction_, *rise_;
  QComboBox* controller_;
  QPushButton* stored_;
  QWidget* stick_;  ///< of a robot with an OPEN-R program
  QLabel* folder_;
  QCheckBox *motorPower_, *camera_;
  SliderForm* form_;
  ParameterSets* sets_;
  DatabaseReader* reader_ = nullptr;
};

}  // namespace btr::ui

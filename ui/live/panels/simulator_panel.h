#pragma once
#include <QTimer>
#include <QWidget>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/live/act.h"
#include "core/live/number_groups.h"

class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;

namespace btr::ui {
class LiveWorld;
class SliderForm;

/// The simulator's numbers and effects while it runs, of one robot or of all: what differs from the scene is bold and
/// goes back by a button. The world is begun anew for each change, so a slider that is dragged sends a few a second.
class SimulatorPanel : public QWidget {
  Q_OBJECT
 public:
  explicit SimulatorPanel(LiveWorld& world, QWidget* parent = nullptr);

  /// Robots, and the one that is selected.
  void showObjects();
  void showSelected();
  /// Values only: somebody changed them.
  void showValues();

 signals:
  void problem(const QString& why);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeNumbers();
  QWidget* makeEffects();
  std::string whose() const;
  void showWhose();
  void showGroup();
  void showEffects();
  void showEffect();
  void showPlaces();
  void showDifferences();
  const PlacedEffect* shownEffect() const;
  void changeNumber(const std::string& name, std::optional<double> value);
  void changeEffect(const std::string& name, std::optional<double> value);
  void resetAll();
  void addEffect();
  void removeEffect();
  /// Done soon; a later act of the same key replaces it.
  void later(const std::string& key, const Act& act);
  void doLater();
  void connectDrags(SliderForm& form);

  LiveWorld& world_;
  bool stale_ = true;  ///< objects came or went while it was hidden
  std::vector<NumberGroup> groups_;
  std::map<std::string, Act> later_;
  QTimer soon_;
  QComboBox *whose_, *group_, *effect_, *place_;
  QLabel* differences_;
  SliderForm *numbers_, *parameters_;
  QListWidget* effects_;
  QPushButton *reset_, *add_, *remove_;
};

}  // namespace btr::ui

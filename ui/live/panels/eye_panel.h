#pragma once
#include <QWidget>
#include <map>
#include <nlohmann/json_fwd.hpp>

#include "core/camera/camera_spec.h"
#include "core/sim/scene.h"
#include "ui/live/eyes/eye_worker.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QUndoStack;
class QVBoxLayout;

namespace btr::ui {
class EyePicture;
class LiveWorld;
class ParameterForm;

/// What a robot's camera sees, live: whose, through which camera, with which of
/// its stages and their numbers; the picture, its colour classes, depth or
/// objects, with boxes of what is really there. Borrows the world.
class EyePanel : public QWidget {
  Q_OBJECT
 public:
  explicit EyePanel(LiveWorld& world, QWidget* parent = nullptr);
  ~EyePanel() override;

  const CameraSpec& camera() const { return camera_; }
  QString robot() const;
  void setRobot(const QString& name);
  void setStage(CameraStage stage, bool on);
  EyePicture& picture() { return *picture_; }
  /// The newest frame as a PNG file, as it is shown, without boxes. False if
  /// there is none or it cannot be written.
  bool savePicture(const QString& path) const;

  /// Robot, camera and what is shown, for a game file.
  nlohmann::json state() const;
  void restore(const nlohmann::json& state);

 signals:
  /// For the page's banner.
  void problem(const QString& why);

 private:
  void fillRobots();
  void chooseCamera(int index);
  void loadCameraFile(const QString& path);
  void fillStages();
  void restart();
  void show(const ShownFrame& frame);
  void askAndSavePicture();
  void askAndSaveCamera();

  LiveWorld& world_;
  CameraSpec camera_;
  QString wanted_;  ///< robot of a restored panel that is not there yet
  QComboBox *robot_, *cameraChoice_, *what_;
  EyePicture* picture_;
  QLabel* told_;
  QWidget* stages_ = nullptr;
  QVBoxLayout* stagesPlace_;
  std::map<CameraStage, QCheckBox*> switches_;
  QUndoStack* undo_;
  EyeWorker* worker_;
};

}  // namespace btr::ui

#pragma once
#include <QColor>
#include <QList>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include "ui/scene3d/renderer.h"
#include "ui/scene3d/scene_builder.h"
#include "ui/scene3d/view_camera.h"
#include "ui/scene3d/view_texts.h"

class QAction;

namespace btr::ui {

/// The 3D view: a widget that paints what the renderer draws, only when something changed. Left drag orbits, middle or
/// Shift drag pans, the wheel zooms; H home, F follow nothing/robot/ball, V keep in view, S shadows, J red or blue
/// jacket; W wireframe, P points, T transparent; B collision shapes, O boxes, A joint axes, C centres of mass, K
/// contacts, R trails. Without OpenGL it says so in words and everything else works on.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  enum class Follow { nothing, robot, ball };

  explicit SceneView(QWidget* parent = nullptr, GlContextFactory factory = createGlContext);
  ~SceneView() override;

  void setRobot(std::shared_ptr<const RobotModel> model);
  void setFurtherRobots(std::vector<std::shared_ptr<const RobotModel>> models);
  void setFurtherJackets(std::vector<std::string> parts);
  void setBalls(std::vector<double> radii_m);
  void setPose(const ScenePose& pose);
  void setGhosts(std::vector<Ghost> ghosts);
  void setGround(Ground ground);
  /// Contacts and trails: drawn while their actions are checked.
  void setWorldMarks(WorldMarks marks);
  void setCarpet(std::optional<CarpetSpec> carpet);
  void setJacket(const QString& part);  ///< "red" or "blue"
  void setFollow(Follow follow);
  Follow follow() const { return follow_; }

  /// Where nothing is followed, the camera goes along before what is looked at (keptInView()) leaves the picture. So it
  /// does until the user moves it aside, and again from home on.
  void setKeepingInView(bool on);
  bool keepsInView() const;

  /// Lines of text in the upper left corner, and badges in the upper right one, topmost first.
  void setCaption(const QStringList& lines);
  void setBadges(const QList<Badge>& badges);

  const ViewCamera& camera() const { return camera_; }
  void setCamera(const ViewCamera& camera);
  void goHome();
  /// The first point of view: on the robot wherever it stands now, whole.
  virtual ViewCamera homeCamera() const;

  /// While true the view may draw coarsely where the machine is slow; it redraws finely afterwards.
  void setMoving(bool moving);

  /// Home, follow, shadows, a menu of surfaces and marks, jacket, save picture: for a tool bar.
  QList<QAction*> viewActions() const;
  QAction* shadowsAction() const { return shadows_; }
  QAction* wireframeAction() const { return surfaces_[0]; }
  QAction* pointsAction() const { return surfaces_[1]; }
  QAction* transparentAction() const { return surfaces_[2]; }
  QAction* markAction(Mark mark) const { return marks_[int(mark)]; }
  QAction* collisionAction() const { return markAction(Mark::collision); }
  QAction* jacketAction() const { return jacket_; }

  /// What the view shows, with its texts, as a picture of that size.
  QImage picture(QSize size);
  /// PNG of picture(); false if the file cannot be written.
  bool savePicture(const QString& path);
  /// Why there is no picture; empty if there is one.
  QString problem() const;

  QSize sizeHint() const override { return {800, 600}; }
  QSize minimumSizeHint() const override { return {200, 150}; }

 signals:
  void cameraChanged();
  void followChanged();
  void markToggled(btr::ui::Mark mark, bool on);
  void panned();  ///< by the user

 protected:
  /// The place that shall not leave the picture; nothing where there is none.
  virtual std::optional<Eigen::Vector3d> keptInView() const;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void makeActions();
  void makeSurfaceActions();
  void makeMarkActions();
  void askAndSave();
  void redraw();
  void applyTheme();
  void applyFollow();
  QImage rendered(QSize pixels, int supersampling);
  void draw(QSize pixels);

  SceneBuilder scene_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of the robot's links
  OffscreenRenderer renderer_;
  ViewCamera camera_;
  Follow follow_ = Follow::nothing;
  QStringList caption_;
  QList<Badge> badges_;
  std::optional<Eigen::Vector3d> keptAt_;  ///< where what is kept in view was when it was looked at last
  QAction *home_, *followAction_, *keep_, *shadows_, *show_, *jacket_, *save_;
  QList<QAction*> surfaces_, marks_;
  QList<std::pair<Qt::Key, QAction*>> keys_;
  QImage image_;         ///< what was rendered last, in device pixels or half of them
  QSize drawnFor_;       ///< the widget's device pixels when it was rendered
  bool stale_ = true;    ///< image_ no longer shows the scene
  bool coarse_ = false;  ///< image_ was drawn without supersampling
  bool moving_ = false;
  double sampleSeconds_ = 0;  ///< what one sample of the last picture took
  QTimer refine_;             ///< draws finely once nothing moves
  QPointF dragFrom_;
  Qt::MouseButton dragButton_ = Qt::NoButton;
};

}  // namespace btr::ui

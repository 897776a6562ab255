#include "ui/scene3d/scene_view.h"
#include "ui/scene3d/link_boxes.h"

#include <QAction>
#include <QElapsedTimer>
#include <QEvent>
#include <QFileDialog>
#include <QKeyEvent>
#include <QMenu>
#include <QMessageBox>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>

namespace btr::ui {
namespace {

constexpr double kMovingPicture_s = 0.030;  ///< finer pictures that would take longer are left for moments of rest

}  // namespace

SceneView::SceneView(QWidget* parent, GlContextFactory factory) : QWidget(parent), renderer_(std::move(factory)) {
  scene_.setLevels(true);
  setFocusPolicy(Qt::StrongFocus);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("3D view of robot, ball and field"));
  makeActions();
  refine_.setSingleShot(true);
  refine_.setInterval(150);
  connect(&refine_, &QTimer::timeout, this, [this] {
    if (coarse_) redraw();
  });
  applyTheme();
}

SceneView::~SceneView() = default;

void SceneView::makeActions() {
  const auto make = [this](const QString& text, const QString& icon, const QString& hint, bool checkable) {
    auto* action = new QAction(QIcon::fromTheme(icon), text, this);
    action->setToolTip(hint);
    action->setCheckable(checkable);
    return action;
  };
  home_ = make(tr("Home"), "go-home", tr("Back to the first point of view (H)"), false);
  followAction_ = make(tr("Follow"), "crosshairs", tr("Keep the robot, the ball or nothing in the middle (F)"), false);
  keep_ = make(tr("Keep in view"), "zoom-fit-best", tr("The camera goes along before a robot leaves the picture (V)"),
               true);
  keep_->setObjectName("keepInView");
  keep_->setChecked(true);
  shadows_ = make(tr("Shadows"), "contrast", tr("Draw shadows (S)"), true);
  shadows_->setChecked(true);
  makeSurfaceActions();
  makeMarkActions();
  show_ = make(tr("Show"), "view-visible", tr("How bodies are drawn, and what explains them"), false);
  show_->setMenu(new QMenu(this));
  show_->menu()->addActions(surfaces_);
  show_->menu()->addSeparator();
  show_->menu()->addActions(marks_);
  show_->menu()->addSeparator();
  show_->menu()->addAction(keep_);
  keys_.append({Qt::Key_V, keep_});
  for (const auto& [key, action] : keys_) action->setText(action->text() + "\t" + QKeySequence(key).toString());
  jacket_ = make(tr("Blue jacket"), "fill-color", tr("Change between the red and the blue jacket (J)"), true);
  save_ = make(tr("Save picture…"), "document-save", tr("Save what is shown as a PNG file"), false);
  keys_ += {{Qt::Key_H, home_}, {Qt::Key_F, followAction_}, {Qt::Key_S, shadows_}, {Qt::Key_J, jacket_}};
  connect(home_, &QAction::triggered, this, &SceneView::goHome);
  connect(followAction_, &QAction::triggered, this, [this] { setFollow(Follow((int(follow_) + 1) % 3)); });
  connect(keep_, &QAction::toggled, this, [this] {
    applyFollow();
    redraw();
  });
  connect(shadows_, &QAction::toggled, this, &SceneView::redraw);
  connect(jacket_, &QAction::toggled, this, [this](bool blue) {
    scene_.setJacket(blue ? "blue" : "red");
    redraw();
  });
  connect(save_, &QAction::triggered, this, &SceneView::askAndSave);
}

/// At most one of them is on; none: shaded.
void SceneView::makeSurfaceActions() {
  const auto add = [this](Surfaces surfaces, const QString& text, const QString& icon, const QString& hint,
                          Qt::Key key) {
    auto* action = new QAction(QIcon::fromTheme(icon), text, this);
    action->setToolTip(hint);
    action->setCheckable(true);
    keys_.append({key, action});
    connect(action, &QAction::toggled, this, [this, action, surfaces](bool on) {
      if (on)
        for (QAction* other : surfaces_)
          if (other != action) other->setChecked(false);
      const bool any = std::ranges::any_of(surfaces_, &QAction::isChecked);
      if (on || !any) scene_.setSurfaces(on ? surfaces : Surfaces::shaded);
      redraw();
    });
    surfaces_.append(action);
  };
  add(Surfaces::wireframe, tr("Wireframe"), "draw-polyline", tr("Draw edges instead of surfaces (W)"), Qt::Key_W);
  add(Surfaces::points, tr("Points"), "draw-spiral", tr("Draw corners instead of surfaces (P)"), Qt::Key_P);
  add(Surfaces::transparent, tr("Transparent"), "edit-opacity", tr("See through bodies (T)"), Qt::Key_T);
}

void SceneView::makeMarkActions() {
  const auto add = [this](Mark mark, const QString& text, const QString& icon, const QString& hint, Qt::Key key) {
    auto* action = new QAction(QIcon::fromTheme(icon), text, this);
    action->setToolTip(hint);
    action->setCheckable(true);
    keys_.append({key, action});
    connect(action, &QAction::toggled, this, [this, mark](bool on) {
      scene_.setMark(mark, on);
      emit markToggled(mark, on);
      redraw();
    });
    marks_.append(action);
  };
  add(Mark::collision, tr("Collision shapes"), "draw-cuboid", tr("Outline what collides; meshes show their box (B)"),
      Qt::Key_B);
  add(Mark::boxes, tr("Boxes"), "draw-rectangle", tr("A box around each link (O)"), Qt::Key_O);
  add(Mark::axes, tr("Joint axes"), "draw-line", tr("Axes and limits of the joints (A)"), Qt::Key_A);
  add(Mark::centres, tr("Centres of mass"), "draw-cross", tr("Centres of mass of the links (C)"), Qt::Key_C);
  add(Mark::contacts, tr("Contacts"), "draw-arrow", tr("Where bodies touch, and with which force: 10 mm a newton (K)"),
      Qt::Key_K);
  add(Mark::trails, tr("Trails"), "draw-freehand", tr("Ways of robots and balls (R)"), Qt::Key_R);
}

QList<QAction*> SceneView::viewActions() const { return {home_, followAction_, shadows_, show_, jacket_, save_}; }

void SceneView::setRobot(std::shared_ptr<const RobotModel> model) {
  boxes_ = model ? linkBoxes(*model) : std::vector<Eigen::AlignedBox3d>();
  scene_.setRobot(std::move(model));
  redraw();
}

void SceneView::setFurtherRobots(std::vector<std::shared_ptr<const RobotModel>> models) {
  scene_.setFurtherRobots(std::move(models));
  redraw();
}

void SceneView::setFurtherJackets(std::vector<std::string> parts) {
  scene_.setFurtherJackets(std::move(parts));
  redraw();
}

void SceneView::setBalls(std::vector<double> radii_m) {
  scene_.setBalls(std::move(radii_m));
  redraw();
}

void SceneView::setPose(const ScenePose& pose) {
  scene_.setPose(pose);
  applyFollow();
  redraw();
}

void SceneView::setGhosts(std::vector<Ghost> ghosts) {
  scene_.setGhosts(std::move(ghosts));
  redraw();
}

void SceneView::setGround(Ground ground) {
  scene_.setGround(ground);
  redraw();
}

void SceneView::setWorldMarks(WorldMarks marks) {
  scene_.setWorldMarks(std::move(marks));
  redraw();
}

void SceneView::setCarpet(std::optional<CarpetSpec> carpet) {
  scene_.setCarpet(std::move(carpet));
  redraw();
}

void SceneView::setJacket(const QString& part) { jacket_->setChecked(part == "blue"); }

void SceneView::setFollow(Follow follow) {
  follow_ = follow;
  const QString names[] = {tr("Follow"), tr("Follows the robot"), tr("Follows the ball")};
  followAction_->setText(names[int(follow)]);
  applyFollow();
  redraw();
  emit followChanged();
}

void SceneView::setKeepingInView(bool on) { keep_->setChecked(on); }
bool SceneView::keepsInView() const { return keep_->isChecked(); }

std::optional<Eigen::Vector3d> SceneView::keptInView() const {
  const auto& links = scene_.pose().links;
  if (links.empty() || !links.front().matrix().allFinite()) return std::nullopt;
  return links.front().translation();
}

/// Moves the focus, and with it the eye, onto what is followed, or after what would leave the picture.
void SceneView::applyFollow() {
  const ScenePose& pose = scene_.pose();
  if (follow_ == Follow::nothing && keepsInView() && dragButton_ == Qt::NoButton) {
    const ViewCamera before = camera_;
    const auto place = keptInView();
    // What stands still stays where it was put in the picture.
    if (place && keptAt_ && (*place - *keptAt_).norm() > 1e-6) camera_.keepInView(*place, size());
    keptAt_ = place;
    if (camera_ != before) emit cameraChanged();
    return;
  }
  const auto& followed = follow_ == Follow::ball ? pose.balls : pose.links;
  if (follow_ != Follow::nothing && !followed.empty() && followed.front().matrix().allFinite())
    camera_.focus = followed.front().translation();
}

void SceneView::setCaption(const QStringList& lines) {
  caption_ = lines;
  update();
}

void SceneView::setBadges(const QList<Badge>& badges) {
  badges_ = badges;
  update();
}

void SceneView::setCamera(const ViewCamera& camera) {
  camera_ = camera;
  if (follow_ != Follow::nothing) applyFollow();
  redraw();
  emit cameraChanged();
}

ViewCamera SceneView::homeCamera() const {
  ViewCamera home;
  if (const auto& links = scene_.pose().links; !links.empty() && links.front().matrix().allFinite()) {
    const Eigen::Vector3d base = links.front().translation();
    home.focus += Eigen::Vector3d(base.x(), base.y(), 0);
    home.showWhole(boxOf(boxes_, links));
  }
  return home;
}

void SceneView::goHome() {
  setFollow(Follow::nothing);
  keep_->setChecked(true);
  setCamera(homeCamera());
}

void SceneView::setMoving(bool moving) {
  moving_ = moving;
  if (!moving && coarse_) refine_.start();
}

void SceneView::redraw() {
  stale_ = true;
  update();
}

QImage SceneView::rendered(QSize pixels, int supersampling) {
  RenderOptions options = scene_.renderOptions();
  options.shadows = shadows_->isChecked();
  options.supersampling = supersampling;
  return renderer_.render(scene_.node(), camera_, pixels, options);
}

QString SceneView::problem() const { return renderer_.problem(); }

QImage SceneView::picture(QSize size) {
  QImage result = rendered(size, 2);
  if (result.isNull()) return result;
  QPainter painter(&result);
  painter.setFont(font());
  drawTexts(painter, size, caption_, badges_);
  return result;
}

bool SceneView::savePicture(const QString& path) {
  const QImage image = picture(size() * devicePixelRatioF());
  return !image.isNull() && image.save(path, "PNG");
}

void SceneView::askAndSave() {
  QString path = QFileDialog::getSaveFileName(this, tr("Save picture"), "picture.png", tr("PNG pictures (*.png)"));
  if (path.isEmpty()) return;
  if (!path.endsWith(".png", Qt::CaseInsensitive)) path += ".png";
  if (!savePicture(path))
    QMessageBox::warning(
        this, tr("Save picture"),
        problem().isEmpty() ? tr("%1 cannot be written.").arg(path) : tr("No picture: %1.").arg(problem()));
}

/// At rest 2 × 2 samples a pixel; while things move as many as the machine draws in time, down to a quarter of one.
void SceneView::draw(QSize pixels) {
  const bool busy = moving_ || dragButton_ != Qt::NoButton || refine_.isActive();
  const double perPixel_s = sampleSeconds_ * pixels.width() * pixels.height();
  const bool fine = !busy || 4 * perPixel_s <= kMovingPicture_s, half = !fine && perPixel_s > kMovingPicture_s;
  const QSize size = half ? QSize((pixels.width() + 1) / 2, (pixels.height() + 1) / 2) : pixels;
  QElapsedTimer watch;
  watch.start();
  image_ = rendered(size, fine ? 2 : 1);
  sampleSeconds_ = watch.nsecsElapsed() * 1e-9 / (double(size.width()) * size.height() * (fine ? 4 : 1));
  coarse_ = !fine;
  stale_ = false;
  drawnFor_ = pixels;
  if (coarse_ && !moving_ && dragButton_ == Qt::NoButton) refine_.start();
}

void SceneView::paintEvent(QPaintEvent*) {
  // Render only what changed.
  const QSize pixels = (QSizeF(size()) * devicePixelRatioF()).toSize();
  const bool resting = !moving_ && dragButton_ == Qt::NoButton && !refine_.isActive();
  if (stale_ || drawnFor_ != pixels || (coarse_ && resting)) draw(pixels);
  QPainter painter(this);
  if (image_.isNull()) {
    painter.fillRect(rect(), palette().window());
    painter.setPen(palette().windowText().color());
    painter.drawText(
        rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap,
        tr("The 3D view needs OpenGL, and this machine offers none:\n%1.\nEverything else works without it.")
            .arg(problem()));
  } else {
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.drawImage(rect(), image_);
  }
  drawTexts(painter, size(), caption_, badges_);
}

void SceneView::mousePressEvent(QMouseEvent* event) {
  if (dragButton_ != Qt::NoButton || (event->button() != Qt::LeftButton && event->button() != Qt::MiddleButton)) return;
  dragButton_ = event->button();
  dragFrom_ = event->position();
}

void SceneView::mouseMoveEvent(QMouseEvent* event) {
  if (dragButton_ == Qt::NoButton) return;
  const QPointF by = event->position() - dragFrom_;
  dragFrom_ = event->position();
  ViewCamera camera = camera_;
  if (dragButton_ == Qt::MiddleButton || event->modifiers() & Qt::ShiftModifier) {
    keep_->setChecked(false);
    if (follow_ != Follow::nothing) setFollow(Follow::nothing);
    camera.pan(by, height());
    emit panned();
  } else {
    camera.orbit(by);
  }
  setCamera(camera);
}

void SceneView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != dragButton_) return;
  dragButton_ = Qt::NoButton;
  if (coarse_) refine_.start();
}

void SceneView::wheelEvent(QWheelEvent* event) {
  ViewCamera camera = camera_;
  camera.zoom(event->angleDelta().y() / 120.0);
  refine_.start();  // more steps may follow
  setCamera(camera);
  event->accept();
}

void SceneView::keyPressEvent(QKeyEvent* event) {
  if (!(event->modifiers() & ~Qt::ShiftModifier))
    for (const auto& [key, action] : keys_)
      if (event->key() == key) return action->trigger();
  QWidget::keyPressEvent(event);  // the panel around takes the rest
}

void SceneView::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) applyTheme();
  QWidget::changeEvent(event);
}

void SceneView::applyTheme() {
  scene_.setDark(palette().window().color().lightnessF() < 0.5);
  redraw();
}

}  // namespace btr::ui

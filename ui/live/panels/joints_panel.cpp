#include "ui/live/panels/joints_panel.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/common/form_undo.h"
#include "ui/common/numbers/decimal_spin_box.h"
#include "ui/common/numbers/format.h"
#include "ui/common/wheel_guard.h"
#include "ui/live/live_world.h"

namespace btr::ui {
namespace {
constexpr int perShown = 10;  ///< slider steps in a degree or millimetre
}

double JointsPanel::Line::perUnit() const { return slides ? 0.001 : 1 / inDegrees; }

JointsPanel::JointsPanel(LiveWorld& world, QWidget* parent)
    : QWidget(parent), world_(world), none_(new QLabel(tr("Select a robot."), this)), area_(new QScrollArea(this)) {
  setObjectName("liveJoints");
  WheelGuard::ensure();
  area_->setWidgetResizable(true);
  area_->setFrameShape(QFrame::NoFrame);
  area_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->addWidget(none_);
  column->addWidget(area_, 1);
}

void JointsPanel::showRobot() {
  const LiveObject* object = world_.isReady() ? world_.selectedObject() : nullptr;
  const bool robot = object && object->kind == LiveObject::Kind::robot;
  none_->setVisible(!robot);
  area_->setVisible(robot);
  if (!robot) {
    robot_.clear();
    lines_.clear();
    area_->setWidget(new QWidget);
    return;
  }
  if (object->name == robot_) return showRow();
  robot_ = object->name;
  lines_.clear();
  auto* content = new QWidget;
  auto* grid = new QGridLayout(content);
  grid->setContentsMargins(0, 0, 4, 0);
  grid->setVerticalSpacing(2);
  grid->setColumnStretch(0, 1);
  const auto spec = std::ranges::find(world_.game().scene.robots, robot_, &RobotSpec::name);
  for (const Joint& joint : world_.models().at(spec->model)->joints)
    if (joint.type != Joint::Type::fixed && !joint.mimic)
      add(content, joint.name, joint.type == Joint::Type::slide, joint.lower, joint.upper);
  area_->setWidget(content);
  showRow();
}

void JointsPanel::add(QWidget* content, const std::string& joint, bool slides, double lower, double upper) {
  auto* grid = static_cast<QGridLayout*>(content->layout());
  Line line;
  line.joint = joint;
  line.slides = slides;
  // A joint without limits turns once around.
  const double widest = slides ? 1 : M_PI;
  const double from = std::max(lower, -widest) / line.perUnit(), to = std::min(upper, widest) / line.perUnit();
  const QString name = word(joint), unit = slides ? tr(" mm") : tr("°");
  line.hold = new QCheckBox(name, content);
  line.hold->setObjectName("hold." + name);
  line.hold->setToolTip(tr("Holds %1 there, whatever the controller says").arg(name));
  line.reached = new QLabel(content);
  line.reached->setObjectName("reached." + name);
  line.reached->setAccessibleName(tr("%1 is at").arg(name));
  line.reached->setToolTip(tr("Where it is now"));
  line.reached->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  line.slider = new QSlider(Qt::Horizontal, content);
  line.slider->setObjectName("angle." + name);
  line.slider->setAccessibleName(tr("%1, slider").arg(name));
  line.slider->setRange(int(std::ceil(from * perShown)), int(std::floor(to * perShown)));
  line.slider->setSingleStep(perShown);
  line.slider->setPageStep(10 * perShown);
  line.number = new DecimalSpinBox(content);
  line.number->setObjectName("number." + name);
  line.number->setAccessibleName(slides ? tr("%1 in mm").arg(name) : tr("%1 in degrees").arg(name));
  line.number->setDecimals(1);
  line.number->setRange(from, to);
  line.number->setSuffix(unit);
  line.number->setKeyboardTracking(false);
  for (QWidget* inside : line.number->findChildren<QWidget*>()) leaveUndoToForm(inside);
  const std::size_t index = lines_.size();
  const int row = 2 * int(index);
  grid->addWidget(line.hold, row, 0);
  grid->addWidget(line.reached, row, 1);
  grid->addWidget(line.slider, row + 1, 0);
  grid->addWidget(line.number, row + 1, 1);
  connect(line.hold, &QCheckBox::toggled, this, [this, index](bool on) { hold(index, on); });
  connect(line.slider, &QSlider::valueChanged, this,
          [this, index](int value) { moveTo(index, double(value) / perShown); });
  connect(line.slider, &QSlider::sliderPressed, &world_.process(), &LiveProcess::beginGesture);
  connect(line.slider, &QSlider::sliderReleased, &world_.process(), &LiveProcess::endGesture);
  connect(line.number, &QDoubleSpinBox::valueChanged, this, [this, index](double value) { moveTo(index, value); });
  lines_.push_back(line);
}

/// Led there, and held.
void JointsPanel::moveTo(std::size_t index, double shown) {
  const Line& line = lines_[index];
  {
    const QSignalBlocker a(line.slider), b(line.number), c(line.hold);
    line.slider->setValue(int(std::lround(shown * perShown)));
    line.number->setValue(shown);
    line.hold->setChecked(true);
  }
  world_.act(HoldAct{robot_, line.joint, shown * line.perUnit()});
}

void JointsPanel::hold(std::size_t index, bool on) {
  const Line& line = lines_[index];
  if (on) return moveTo(index, line.number->value());
  world_.act(HoldAct{robot_, line.joint, std::nullopt});
}

void JointsPanel::showRow() {
  const int object = world_.indexOf(robot_);
  if (object < 0 || !world_.isReady()) return;
  const Values joints = world_.scene().jointsOf(std::size_t(object), world_.row());
  const auto held = world_.held(robot_);
  for (const Line& line : lines_) {
    const auto now = joints.find(line.joint);
    if (now == joints.end()) continue;
    const double shown = now->second / line.perUnit();
    line.reached->setText(line.slides ? tr("%1 mm").arg(shown, 0, 'f', 1) : degrees(now->second));
    const auto wanted = held.find(line.joint);
    const QSignalBlocker a(line.slider), b(line.number), c(line.hold);
    line.hold->setChecked(wanted != held.end());
    if (line.slider->isSliderDown() || line.number->hasFocus()) continue;
    const double target = wanted == held.end() ? shown : wanted->second / line.perUnit();
    line.slider->setValue(int(std::lround(target * perShown)));
    line.number->setValue(target);
  }
}

void JointsPanel::showJoint(const std::string& joint) {
  for (const Line& line : lines_)
    if (line.joint == joint) area_->ensureWidgetVisible(line.slider);
}

}  // namespace btr::ui

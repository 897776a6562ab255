#include "ui/live/panels/eye_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSplitter>
#include <QUndoStack>
#include <QVBoxLayout>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "ui/common/look/section.h"
#include "ui/common/resources.h"
#include "ui/experiment/parameter_form.h"
#include "ui/live/eyes/eye_picture.h"
#include "ui/live/live_world.h"

namespace btr::ui {
namespace {

QString camerasFolder() { return resourceDirectory() + "/cameras"; }

QString titleOf(CameraStage stage) {
  switch (stage) {
    case CameraStage::lens:
      return EyePanel::tr("Lens");
    case CameraStage::vignetting:
      return EyePanel::tr("Vignetting");
    case CameraStage::shutter:
      return EyePanel::tr("Shutter");
    case CameraStage::colour:
      return EyePanel::tr("Colour filter and white balance");
    case CameraStage::noise:
      return EyePanel::tr("Noise");
    case CameraStage::gamma:
      return EyePanel::tr("Gamma");
    case CameraStage::ycbcr:
      return EyePanel::tr("YCbCr 4:2:2");
    case CameraStage::classes:
      return EyePanel::tr("Colour classes");
    case CameraStage::jpeg:
      return EyePanel::tr("JPEG");
  }
  return {};
}

}  // namespace

EyePanel::EyePanel(LiveWorld& world, QWidget* parent)
    : QWidget(parent), world_(world), undo_(new QUndoStack(this)), worker_(new EyeWorker(this)) {
  setObjectName("eyePanel");
  robot_ = new QComboBox(this);
  robot_->setObjectName("eyeRobot");
  cameraChoice_ = new QComboBox(this);
  cameraChoice_->setObjectName("eyeCamera");
  for (const auto& [text, file] : {std::pair{tr("ERS-7, 208 × 160"), "ers7"},
                                   {tr("ERS-7, 416 × 320"), "ers7-416x320"},
                                   {tr("ERS-210, 176 × 144"), "ers210"}})
    cameraChoice_->addItem(text, camerasFolder() + "/" + file + ".json");
  cameraChoice_->addItem(tr("From a file…"));
  what_ = new QComboBox(this);
  what_->setObjectName("eyeWhat");
  what_->addItems({tr("Picture"), tr("Colour classes"), tr("Depth: white from 3 m"), tr("Objects")});
  auto* boxes = new QCheckBox(tr("Boxes of what is really there"), this);
  boxes->setChecked(true);
  picture_ = new EyePicture(this);
  told_ = new QLabel(this);
  told_->setTextInteractionFlags(Qt::TextSelectableByMouse);

  auto* form = new QFormLayout;
  form->addRow(tr("&Robot"), robot_);
  form->addRow(tr("&Camera"), cameraChoice_);
  form->addRow(tr("S&how"), what_);
  form->addRow(boxes);
  auto* savePicture = new QPushButton(tr("Save picture…"), this);
  auto* saveCamera = new QPushButton(tr("Save camera…"), this);
  form->addRow(savePicture, saveCamera);
  auto* side = new QWidget(this);
  stagesPlace_ = new QVBoxLayout(side);
  stagesPlace_->setContentsMargins(4, 4, 4, 4);
  stagesPlace_->addLayout(form);
  stagesPlace_->addStretch(1);
  auto* scroll = new QScrollArea(this);
  scroll->setWidget(side);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* left = new QWidget(this);
  auto* leftLayout = new QVBoxLayout(left);
  leftLayout->setContentsMargins(0, 0, 0, 0);
  leftLayout->addWidget(picture_, 1);
  leftLayout->addWidget(told_);
  auto* split = new QSplitter(this);
  split->addWidget(left);
  split->addWidget(scroll);
  split->setStretchFactor(0, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addWidget(split);

  connect(robot_, &QComboBox::activated, this, &EyePanel::restart);
  connect(cameraChoice_, &QComboBox::activated, this, &EyePanel::chooseCamera);
  connect(what_, &QComboBox::activated, this, [this](int index) { worker_->setWhat(ShownFrame::What(index)); });
  connect(boxes, &QCheckBox::toggled, picture_, &EyePicture::setBoxes);
  connect(savePicture, &QPushButton::clicked, this, &EyePanel::askAndSavePicture);
  connect(saveCamera, &QPushButton::clicked, this, &EyePanel::askAndSaveCamera);
  connect(worker_, &EyeWorker::shown, this, &EyePanel::show);
  connect(worker_, &EyeWorker::failed, this, [this](const QString& why) {
    picture_->setMessage(why);
    told_->clear();
  });
  connect(&world_, &LiveWorld::objectsChanged, this, [this] {
    fillRobots();
    restart();
  });
  connect(&world_, &LiveWorld::rowChanged, this, [this] { worker_->add(world_.row()); });
  fillRobots();
  loadCameraFile(cameraChoice_->itemData(0).toString());
}

EyePanel::~EyePanel() = default;

nlohmann::json EyePanel::state() const {
  return {{"robot", robot().toStdString()},
          {"camera", nlohmann::json::parse(toJsonText(camera_))},
          {"shows", what_->currentIndex()}};
}

void EyePanel::restore(const nlohmann::json& state) {
  if (!state.is_object()) return;
  if (const auto robot = state.find("robot"); robot != state.end() && robot->is_string())
    wanted_ = QString::fromStdString(robot->get<std::string>());
  if (const auto shows = state.find("shows"); shows != state.end() && shows->is_number_integer())
    what_->setCurrentIndex(std::clamp(shows->get<int>(), 0, what_->count() - 1));
  worker_->setWhat(ShownFrame::What(what_->currentIndex()));
  try {
    if (state.contains("camera")) camera_ = cameraFromJson(state.at("camera").dump(), "view");
  } catch (const InputError& error) {
    emit problem(QString::fromStdString(error.what()));
  }
  fillStages();
  fillRobots();
  restart();
}

QString EyePanel::robot() const { return robot_->currentText(); }

void EyePanel::setRobot(const QString& name) {
  wanted_ = name;
  robot_->setCurrentText(name);
  restart();
}

/// The robot that was chosen stays; the camera follows the first robot's kind.
void EyePanel::fillRobots() {
  const QString before = wanted_.isEmpty() ? robot() : wanted_;
  robot_->clear();
  for (const LiveObject& object : world_.objects())
    if (object.kind == LiveObject::Kind::robot) robot_->addItem(QString::fromStdString(object.name));
  robot_->setCurrentIndex(std::max(0, robot_->findText(before)));
}

void EyePanel::chooseCamera(int index) {
  QString path = cameraChoice_->itemData(index).toString();
  if (path.isEmpty()) path = QFileDialog::getOpenFileName(this, tr("Camera"), camerasFolder(), tr("Cameras (*.json)"));
  if (!path.isEmpty()) loadCameraFile(path);
}

void EyePanel::loadCameraFile(const QString& path) {
  try {
    camera_ = loadCamera(path.toStdString());
  } catch (const InputError& error) {
    emit problem(QString::fromStdString(error.what()));
    return;
  }
  fillStages();
  restart();
}

/// A switch and the numbers of each stage, in the order of the light's way.
void EyePanel::fillStages() {
  delete stages_;
  switches_.clear();
  stages_ = new QWidget(this);
  auto* layout = new QVBoxLayout(stages_);
  layout->setContentsMargins(0, 0, 0, 0);
  for (const CameraStage stage : cameraStages()) {
    auto* on = new QCheckBox(titleOf(stage), stages_);
    on->setObjectName("stage_" + QString::fromStdString(nameOf(stage)));
    on->setToolTip(QString::fromStdString(meaningOf(stage)));
    on->setChecked(camera_[stage].on);
    connect(on, &QCheckBox::toggled, this, [this, stage](bool checked) {
      camera_[stage].on = checked;
      worker_->setCamera(camera_);
    });
    layout->addWidget(on);
    switches_[stage] = on;
    const auto declared = parametersOf(stage);
    if (declared.empty()) continue;
    auto* form = new ParameterForm({declared.begin(), declared.end()}, *undo_, stages_);
    form->setValues(camera_[stage].values);
    connect(form, &ParameterForm::changed, this, [this, stage](const Values& values) {
      camera_[stage].values = values;
      restart();
    });
    auto* section = new Section(tr("Numbers"), form, stages_);
    section->setOpen(false);
    layout->addWidget(section);
  }
  stagesPlace_->insertWidget(1, stages_);
}

void EyePanel::setStage(CameraStage stage, bool on) { switches_.at(stage)->setChecked(on); }

void EyePanel::restart() {
  if (robot().isEmpty()) {
    picture_->setMessage(tr("No robot is there."));
    return;
  }
  worker_->look([game = world_.game(), models = world_.models(), channels = world_.channels(),
                 robot = robot().toStdString(),
                 camera = camera_] { return std::make_unique<LiveEye>(game, models, channels, robot, camera); });
  if (!world_.row().values.empty()) worker_->add(world_.row());
}

void EyePanel::show(const ShownFrame& frame) {
  picture_->setFrame(frame);
  told_->setText(tr("Frame %1 at %2 s, made in %3 ms")
                     .arg(frame.number)
                     .arg(frame.time_s, 0, 'f', 3)
                     .arg(frame.took_ms, 0, 'f', 1));
}

bool EyePanel::savePicture(const QString& path) const {
  return !picture_->frame().image.isNull() && picture_->frame().image.save(path, "PNG");
}

void EyePanel::askAndSavePicture() {
  QString path = QFileDialog::getSaveFileName(this, tr("Save picture"), "camera.png", tr("PNG pictures (*.png)"));
  if (path.isEmpty()) return;
  if (!path.endsWith(".png", Qt::CaseInsensitive)) path += ".png";
  if (!savePicture(path)) emit problem(tr("%1 cannot be written, or there is no picture yet.").arg(path));
}

void EyePanel::askAndSaveCamera() {
  QString path = QFileDialog::getSaveFileName(this, tr("Save camera"), "camera.json", tr("Cameras (*.json)"));
  if (path.isEmpty()) return;
  if (!path.endsWith(".json", Qt::CaseInsensitive)) path += ".json";
  try {
    writeFile(path.toStdString(), toJsonText(camera_));
  } catch (const InputError& error) {
    emit problem(QString::fromStdString(error.what()));
  }
}

}  // namespace btr::ui

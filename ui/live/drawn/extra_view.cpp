#include "ui/live/drawn/extra_view.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <nlohmann/json.hpp>

#include "ui/live/live_world.h"

namespace btr::ui {

ExtraView::ExtraView(LiveWorld& world, QWidget* parent) : QWidget(parent), world_(world), view_(new LiveView(this)) {
  setObjectName("extraView");
  mode_ = new QComboBox(this);
  mode_->setObjectName("viewMode");
  mode_->setAccessibleName(tr("How the camera goes with the world"));
  mode_->addItems({tr("Free"), tr("Follows"), tr("Aboard"), tr("From the top")});
  object_ = new QComboBox(this);
  object_->setObjectName("viewObject");
  object_->setAccessibleName(tr("The object that the camera goes with"));
  auto* tools = new QHBoxLayout;
  tools->addWidget(mode_);
  tools->addWidget(object_);
  tools->addStretch(1);
  for (QAction* action : view_->viewActions()) {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    if (action->menu()) button->setPopupMode(QToolButton::InstantPopup);
    tools->addWidget(button);
  }
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(2, 2, 2, 2);
  layout->addLayout(tools);
  layout->addWidget(view_, 1);
  view_->setGround(Ground::plain);
  view_->setKeepingInView(false);  // it has modes for that

  connect(mode_, &QComboBox::currentIndexChanged, this, [this](int index) {
    object_->setEnabled(ViewMode(index) != ViewMode::free);
    showRow();
  });
  connect(object_, &QComboBox::currentIndexChanged, this, &ExtraView::showRow);
  connect(&world_, &LiveWorld::objectsChanged, this, [this] {
    view_->setScene(world_.scene());
    fillObjects();
  });
  connect(&world_, &LiveWorld::rowChanged, this, &ExtraView::showRow);
  connect(&world_, &LiveWorld::selectionChanged, this, [this] { view_->select(world_.selection()); });
  connect(view_, &LiveView::picked, this, [this](const std::string& object) { world_.select({object}); });
  object_->setEnabled(false);
  view_->setScene(world_.scene());
  fillObjects();
  showRow();
}

ViewMode ExtraView::mode() const { return ViewMode(mode_->currentIndex()); }
void ExtraView::setMode(ViewMode mode) { mode_->setCurrentIndex(int(mode)); }
QString ExtraView::object() const { return object_->currentText(); }

void ExtraView::setObject(const QString& name) {
  wanted_ = name;
  if (const int index = object_->findText(name); index >= 0) object_->setCurrentIndex(index);
}

void ExtraView::fillObjects() {
  const QString before = wanted_.isEmpty() ? object() : wanted_;
  const QSignalBlocker quiet(object_);
  object_->clear();
  for (const LiveObject& object : world_.objects())
    if (object.moves) object_->addItem(QString::fromStdString(object.name));
  object_->setCurrentIndex(std::max(0, object_->findText(before)));
}

void ExtraView::showRow() {
  const LiveRow& row = world_.row();
  if (row.values.empty()) return;
  view_->setMoving(row.playing);
  const ViewCamera camera = cameraFor(mode(), object().toStdString(), view_->camera(), world_.scene(), row);
  if (camera != view_->camera()) view_->setCamera(camera);
  view_->setRow(row);
}

nlohmann::json ExtraView::state() const {
  return {{"mode", nameOf(mode())}, {"object", object().toStdString()}, {"camera", toJson(view_->camera())}};
}

void ExtraView::restore(const nlohmann::json& state) {
  if (!state.is_object()) return;
  if (state.contains("camera")) view_->setCamera(viewCameraFrom(state.at("camera")));
  const auto text = [&](const char* key) {
    const auto found = state.find(key);
    return found != state.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  setObject(QString::fromStdString(text("object")));
  for (int i = 0; i < kViewModes; ++i)
    if (text("mode") == nameOf(ViewMode(i))) setMode(ViewMode(i));
}

}  // namespace btr::ui

#include "ui/live/panels/slider_form.h"

#include <QGridLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/common/form_undo.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/common/numbers/number_edit.h"
#include "ui/common/wheel_guard.h"
#include "ui/experiment/parameter_text.h"

namespace btr::ui {
namespace {

constexpr int sliderSteps = 1000;

/// What a slider spans: the bounds, or, where they are far wider than the usual value, some times that.
std::pair<double, double> spanOf(const Parameter& parameter, double usual) {
  constexpr double wide = 30, times = 4;
  const double size = std::abs(usual);
  double low = parameter.minimum, high = parameter.maximum;
  if (size > 0 && high > wide * size) high = times * size;
  if (size > 0 && low < -wide * size) low = -times * size;
  if (size == 0 && high > wide) high = 1;
  if (size == 0 && low < -wide) low = -1;
  return {low, high};
}

}  // namespace

SliderForm::SliderForm(QWidget* parent) : QWidget(parent) {
  WheelGuard::ensure();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  refused_ = new QLabel(this);
  refused_->setObjectName("refused");
  refused_->setWordWrap(true);
  refused_->hide();
  column->addWidget(refused_);
  column->addStretch();
}

void SliderForm::setParameters(const std::vector<Parameter>& parameters, const Values& usual) {
  const bool same = content_ && usual == usual_ &&
                    std::ranges::equal(parameters, lines_, {}, &Parameter::name,
                                       [](const Line& line) { return line.parameter.name; });
  if (same) return;  // what is being typed stays
  usual_ = usual;
  refused_->hide();
  delete content_;
  lines_.clear();
  lines_.reserve(parameters.size());
  values_.clear();
  content_ = new QWidget(this);
  auto* grid = new QGridLayout(content_);
  grid->setContentsMargins(0, 0, 4, 0);
  grid->setVerticalSpacing(2);
  grid->setColumnStretch(0, 3);
  grid->setColumnStretch(1, 2);
  for (const Parameter& parameter : parameters) {
    const auto found = usual.find(parameter.name);
    add(parameter, found == usual.end() ? parameter.byDefault : found->second);
  }
  static_cast<QVBoxLayout*>(layout())->insertWidget(0, content_);
  content_->show();
}

void SliderForm::add(const Parameter& parameter, double usual) {
  auto* grid = static_cast<QGridLayout*>(content_->layout());
  Line line;
  line.parameter = parameter;
  line.usual = usual;
  std::tie(line.low, line.high) = spanOf(parameter, usual);
  const QString name = labelOf(parameter), tip = toolTipOf(parameter);
  line.label = new QLabel(content_);
  line.label->setToolTip(tip);
  line.slider = new QSlider(Qt::Horizontal, content_);
  line.slider->setObjectName("slider." + word(parameter.name));
  line.slider->setAccessibleName(tr("%1, slider").arg(name));
  line.slider->setToolTip(tip);
  line.slider->setRange(0, sliderSteps);
  line.slider->setPageStep(sliderSteps / 20);
  line.number = new NumberEdit(content_);
  line.number->setObjectName("number." + word(parameter.name));
  line.number->setAccessibleName(parameter.unit.empty() ? name : tr("%1 in %2").arg(name, word(parameter.unit)));
  line.number->setToolTip(tip);
  line.number->setRange(parameter.minimum, parameter.maximum, parameter.integer);
  for (QWidget* inside : line.number->findChildren<QWidget*>()) leaveUndoToForm(inside);
  line.back = new QToolButton(content_);
  line.back->setObjectName("back." + word(parameter.name));
  line.back->setIcon(themeIcon("edit-undo"));
  line.back->setAutoRaise(true);
  line.back->setAccessibleName(tr("Reset %1").arg(name));
  line.back->setToolTip(tr("Back to %1").arg(withUnit(usual, word(parameter.unit))));
  const int row = 2 * int(lines_.size());
  grid->addWidget(line.label, row, 0, 1, 3);
  grid->addWidget(line.slider, row + 1, 0);
  grid->addWidget(line.number, row + 1, 1);
  grid->addWidget(line.back, row + 1, 2);
  line.label->setBuddy(line.number);
  const std::size_t index = lines_.size();
  connect(line.slider, &QSlider::sliderPressed, this, &SliderForm::dragBegan);
  connect(line.slider, &QSlider::sliderReleased, this, &SliderForm::dragEnded);
  connect(line.slider, &QSlider::valueChanged, this, [this, index](int step) {
    const Line& moved = lines_[index];
    double value = moved.low + (moved.high - moved.low) * step / sliderSteps;
    if (moved.parameter.integer) value = std::round(value);
    value = std::clamp(value, moved.parameter.minimum, moved.parameter.maximum);
    set(index, value);
  });
  connect(line.number, &NumberEdit::edited, this, [this, index](const QString& text) {
    const auto value = fieldValue(lines_[index].parameter, text);
    lines_[index].number->setMarked(!value);
    if (value) refused_->hide();
    if (value) set(index, value);
  });
  connect(line.number, &NumberEdit::editingFinished, this, [this, index] { giveUp(index); });
  connect(line.back, &QToolButton::clicked, this, [this, index] { set(index, std::nullopt); });
  lines_.push_back(line);
  show(lines_.back());
}

/// What is not allowed and was left so stands there no longer as if it were in force.
void SliderForm::giveUp(std::size_t index) {
  Line& line = lines_[index];
  const QString typed = line.number->numberText();
  if (fieldValue(line.parameter, typed)) return;
  show(line);
  refused_->setText(tr("%1: \"%2\" is not allowed, %3 is; it stays %4.")
                        .arg(labelOf(line.parameter), typed.trimmed(), allowedText(line.parameter),
                             withUnit(value(line.parameter.name), word(line.parameter.unit))));
  refused_->show();
}

void SliderForm::setValues(const Values& values) {
  values_.clear();
  for (Line& line : lines_) {
    if (const auto found = values.find(line.parameter.name); found != values.end()) values_.insert(*found);
    if (!line.slider->isSliderDown() && !line.number->hasFocus()) show(line);
  }
}

double SliderForm::value(const std::string& name) const {
  if (const auto found = values_.find(name); found != values_.end()) return found->second;
  const auto line = std::ranges::find_if(lines_, [&](const Line& each) { return each.parameter.name == name; });
  return line == lines_.end() ? 0 : line->usual;
}

int SliderForm::changedCount() const {
  return int(
      std::ranges::count_if(lines_, [this](const Line& line) { return value(line.parameter.name) != line.usual; }));
}

void SliderForm::set(std::size_t index, std::optional<double> value) {
  Line& line = lines_[index];
  if (value == (values_.contains(line.parameter.name) ? std::optional(values_[line.parameter.name]) : std::nullopt))
    return;
  if (value)
    values_[line.parameter.name] = *value;
  else
    values_.erase(line.parameter.name);
  show(line);
  emit edited(line.parameter.name, value);
}

void SliderForm::show(Line& line) {
  const double now = value(line.parameter.name);
  const bool differs = now != line.usual;
  const QString unit = line.parameter.unit.empty() ? QString() : QString(" (%1)").arg(word(line.parameter.unit));
  line.label->setText(labelOf(line.parameter) + unit);
  QFont font = line.label->font();
  font.setBold(differs);
  line.label->setFont(font);
  line.back->setEnabled(values_.contains(line.parameter.name));
  line.number->setNumberText(fieldText(line.parameter, now));
  line.number->setMarked(false);
  if (line.slider->isSliderDown()) return;
  const QSignalBlocker quiet(line.slider);
  const double share = line.high > line.low ? (now - line.low) / (line.high - line.low) : 0;
  line.slider->setValue(int(std::lround(std::clamp(share, 0.0, 1.0) * sliderSteps)));
}

}  // namespace btr::ui

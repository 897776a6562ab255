#include "ui/experiment/plugin_form.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QUndoStack>
#include <QVBoxLayout>

#include "ui/common/edit_command.h"
#include "ui/common/wheel_guard.h"
#include "ui/experiment/parameter_form.h"

namespace btr::ui {

PluginForm::PluginForm(const QString& what, const std::vector<Offer>& offers, QUndoStack& undo, QWidget* parent)
    : QWidget(parent), what_(what), undo_(undo), names_(new QComboBox(this)) {
  WheelGuard::ensure();
  names_->setAccessibleName(what);
  names_->setToolTip(tr("%1: one of the installed plugins").arg(what));
  names_->setFocusPolicy(Qt::StrongFocus);
  connect(names_, &QComboBox::activated, this, [this](int index) {
    if (index == chosen_) return;
    undo_.push(new EditCommand(tr("choose %1").arg(names_->itemText(index)), {}, -1, chosen_, index,
                               [this](const QVariant& value) {
                                 select(value.toInt());
                                 emit changed();
                               }));
  });

  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 2, 8, 2);
  auto* label = new QLabel(what, this);
  label->setBuddy(names_);
  row->addWidget(label);
  row->addWidget(names_, 1);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addLayout(row);
  for (const Offer& offer : offers) add(offer);
  if (!offers_.empty()) select(0);
}

void PluginForm::add(const Offer& offer) {
  offers_.push_back(offer);
  names_->addItem(offer.name);
  names_->setItemData(names_->count() - 1, offer.hint, Qt::ToolTipRole);
  auto* page = new QWidget(this);
  auto* column = new QVBoxLayout(page);
  column->setContentsMargins(0, 0, 0, 0);
  if (!offer.hint.isEmpty()) {
    auto* hint = new QLabel(offer.hint, page);
    hint->setWordWrap(true);
    hint->setContentsMargins(8, 2, 8, 2);
    hint->setForegroundRole(QPalette::PlaceholderText);
    column->addWidget(hint);
  }
  auto* form = new ParameterForm(offer.settings, undo_, page);
  column->addWidget(form);
  column->addStretch();
  connect(form, &ParameterForm::changed, this, &PluginForm::changed);
  page->hide();
  pages_.push_back(page);
  layout()->addWidget(page);
}

void PluginForm::addOffers(const std::vector<Offer>& offers) {
  const bool wasMissing = chosen_ >= offerCount();
  while (names_->count() > offerCount()) names_->removeItem(names_->count() - 1);
  for (const Offer& offer : offers)
    if (names_->findText(offer.name) < 0) add(offer);
  if (wasMissing) setChoice(PluginChoice(missing_));
}

void PluginForm::setChoice(const PluginChoice& choice) {
  int index = -1;
  for (int i = 0; i < offerCount(); ++i)
    if (offers_[std::size_t(i)].name.toStdString() == choice.name) index = i;
  const Values values =
      index < 0 ? Values{} : settingsOf(choice, offers_[std::size_t(index)].settings, choice.name + " settings");

  while (names_->count() > offerCount()) names_->removeItem(names_->count() - 1);
  missing_ = {};
  if (index < 0) {
    missing_ = choice;
    index = names_->count();
    names_->addItem(choice.name.empty() ? tr("(choose)")
                                        : tr("%1 (not installed)").arg(QString::fromStdString(choice.name)));
  }
  select(index);
  if (ParameterForm* form = page()) form->setValues(values);
  emit changed();
}

PluginChoice PluginForm::choice() const {
  if (const ParameterForm* form = page())
    return choiceOf(offers_[std::size_t(chosen_)].name.toStdString(), form->values(),
                    offers_[std::size_t(chosen_)].settings);
  return missing_;
}

bool PluginForm::isValid() const { return page() && page()->isValid(); }

QStringList PluginForm::problems() const {
  if (const ParameterForm* form = page()) return form->problems();
  return {missing_.name.empty() ? tr("%1: nothing is chosen").arg(what_)
                                : tr("%1: %2 is not installed").arg(what_, QString::fromStdString(missing_.name))};
}

void PluginForm::setReadOnly(bool readOnly) {
  names_->setEnabled(!readOnly);
  for (auto* form : findChildren<ParameterForm*>()) form->setReadOnly(readOnly);
}

void PluginForm::resetAll() {
  if (ParameterForm* form = page()) form->resetAll();
}

int PluginForm::changedCount() const { return page() ? page()->changedCount() : 0; }

ParameterForm* PluginForm::page() const {
  return chosen_ < offerCount() ? pages_[std::size_t(chosen_)]->findChild<ParameterForm*>() : nullptr;
}

// Only the chosen page takes room. (A stacked widget would be as high as the longest form.)
void PluginForm::select(int index) {
  chosen_ = index;
  names_->setCurrentIndex(index);
  for (int i = 0; i < offerCount(); ++i) pages_[std::size_t(i)]->setVisible(i == index);
}

}  // namespace btr::ui

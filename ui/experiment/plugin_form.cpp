#include "ui/experiment/plugin_form.h"
#include "ui/common/undoable_line.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QUndoStack>
#include <QVBoxLayout>

#include "ui/common/edit_command.h"
#include "ui/common/look/combo_width.h"
#include "ui/common/wheel_guard.h"
#include "ui/experiment/parameter_form.h"

namespace btr::ui {

PluginForm::PluginForm(const QString& what, const std::vector<Offer>& offers, QUndoStack& undo, QWidget* parent)
    : QWidget(parent), what_(what), undo_(undo), names_(new QComboBox(this)) {
  WheelGuard::ensure();
  names_->setAccessibleName(what);
  names_->setToolTip(tr("%1: one of the installed plugins").arg(what));
  names_->setFocusPolicy(Qt::StrongFocus);
  letShrink(*names_);
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
  for (const std::string& path : offer.paths) column->addWidget(addPath(page, offer, path)->parentWidget());
  auto* form = new ParameterForm(offer.settings, undo_, page);
  column->addWidget(form);
  column->addStretch();
  connect(form, &ParameterForm::changed, this, &PluginForm::changed);
  page->hide();
  pages_.push_back(page);
  layout()->addWidget(page);
}

QLineEdit* PluginForm::addPath(QWidget* page, const Offer& offer, const std::string& name) {
  const QString label = QString::fromStdString(name);
  auto* line = new QWidget(page);
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(8, 2, 8, 2);
  auto* caption = new QLabel(label, line);
  auto* edit = new QLineEdit(line);
  caption->setBuddy(edit);
  edit->setObjectName(offer.name + "." + label);
  edit->setAccessibleName(label);
  edit->setToolTip(tr("A file or folder, relative to the experiment's file"));
  row->addWidget(caption);
  row->addWidget(edit, 1);
  makeUndoable(*edit, undo_, tr("change %1").arg(label), [this] { emit changed(); });
  return edit;
}

QLineEdit* PluginForm::pathEdit(int offer, const std::string& name) const {
  return pages_[std::size_t(offer)]->findChild<QLineEdit*>(offers_[std::size_t(offer)].name + "." +
                                                           QString::fromStdString(name));
}

PluginChoice PluginForm::withoutPaths(PluginChoice choice, const Offer& offer) {
  for (const std::string& path : offer.paths) choice.words.erase(path);
  return choice;
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
  Values values;
  if (index >= 0) {
    const Offer& offer = offers_[std::size_t(index)];
    values = settingsOf(withoutPaths(choice, offer), offer.settings, choice.name + " settings");
    for (const std::string& path : offer.paths) {
      const auto given = choice.words.find(path);
      pathEdit(index, path)->setText(given == choice.words.end() ? QString() : QString::fromStdString(given->second));
    }
  }

  while (names_->count() > offerCount()) names_->removeItem(names_->count() - 1);
  missing_ = {};
  if (index < 0) {
    missing_ = choice;
    index = names_->count();
    names_->addItem(choice.name.empty() ? tr("(choose)")
                                        : tr("%1 (not installed)").arg(QString::fromStdString(choice.name)));
  }
  select(index);
  if (ParameterForm* form = numbers()) form->setValues(values);
  emit changed();
}

PluginChoice PluginForm::choice() const {
  const ParameterForm* form = numbers();
  if (!form) return missing_;
  const Offer& offer = offers_[std::size_t(chosen_)];
  PluginChoice choice = choiceOf(offer.name.toStdString(), form->values(), offer.settings);
  for (const std::string& path : offer.paths)
    choice.words[path] = pathEdit(chosen_, path)->text().trimmed().toStdString();
  return choice;
}

bool PluginForm::isValid() const { return numbers() && problems().isEmpty(); }

QStringList PluginForm::problems() const {
  if (const ParameterForm* form = numbers()) {
    QStringList problems = form->problems();
    for (const std::string& path : offers_[std::size_t(chosen_)].paths)
      if (pathEdit(chosen_, path)->text().trimmed().isEmpty())
        problems << tr("%1: %2 is missing, a path relative to the experiment's file")
                        .arg(what_, QString::fromStdString(path));
    return problems;
  }
  return {missing_.name.empty() ? tr("%1: nothing is chosen").arg(what_)
                                : tr("%1: %2 is not installed").arg(what_, QString::fromStdString(missing_.name))};
}

void PluginForm::setReadOnly(bool readOnly) {
  names_->setEnabled(!readOnly);
  for (auto* form : findChildren<ParameterForm*>()) form->setReadOnly(readOnly);
  for (int i = 0; i < offerCount(); ++i)
    for (const std::string& path : offers_[std::size_t(i)].paths) pathEdit(i, path)->setReadOnly(readOnly);
}

void PluginForm::resetAll() {
  if (ParameterForm* form = numbers()) form->resetAll();
}

int PluginForm::changedCount() const { return numbers() ? numbers()->changedCount() : 0; }

ParameterForm* PluginForm::numbers() const {
  return chosen_ < offerCount() ? pages_[std::size_t(chosen_)]->findChild<ParameterForm*>() : nullptr;
}

// Only the chosen page takes room. (A stacked widget would be as high as the longest form.)
void PluginForm::select(int index) {
  chosen_ = index;
  names_->setCurrentIndex(index);
  for (int i = 0; i < offerCount(); ++i) pages_[std::size_t(i)]->setVisible(i == index);
}

}  // namespace btr::ui

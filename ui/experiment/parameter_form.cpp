#include "ui/experiment/parameter_form.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QUndoStack>
#include <algorithm>

#include "ui/common/edit_command.h"
#include "ui/common/look/theme.h"
#include "ui/experiment/parameter_field.h"
#include "ui/experiment/parameter_text.h"

namespace btr::ui {
namespace {

QVariant toVariant(const std::optional<QString>& text) { return text ? QVariant(*text) : QVariant(); }
std::optional<QString> fromVariant(const QVariant& value) {
  return value.isValid() ? std::optional(value.toString()) : std::nullopt;
}

}  // namespace

ParameterForm::ParameterForm(const std::vector<Parameter>& parameters, QUndoStack& undo, const Options& options,
                             QWidget* parent)
    : QWidget(parent), undo_(undo), search_(new QLineEdit(this)), nothing_(new QLabel(tr("No field fits."), this)) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(8, 4, 4, 4);
  grid->setHorizontalSpacing(8);
  grid->setVerticalSpacing(3);
  grid->setColumnStretch(1, 3);
  grid->setColumnStretch(2, 4);

  search_->setObjectName("search");
  search_->setPlaceholderText(tr("Find a field"));
  search_->setAccessibleName(tr("Find a field"));
  search_->setClearButtonEnabled(true);
  search_->addAction(themeIcon("search"), QLineEdit::LeadingPosition);
  search_->setVisible(int(parameters.size()) >= options.filterFrom);
  connect(search_, &QLineEdit::textChanged, this, &ParameterForm::filter);
  grid->addWidget(search_, 0, 0, 1, 5);
  nothing_->hide();
  grid->addWidget(nothing_, 1, 0, 1, 5);

  int row = 2;
  for (const Parameter& parameter : parameters) {
    auto* field = new ParameterField(parameter, options.checkable, this);
    field->place(*grid, row);
    row += 2;
    connect(field, &ParameterField::edited, this, [this, field](const auto& text) { edit(*field, text); });
    connect(field, &ParameterField::checkEdited, this, [this, field](bool on) {
      undo_.push(new EditCommand(tr("choose %1").arg(labelOf(field->parameter())), {}, -1, !on, on,
                                 [this, field](const QVariant& value) {
                                   field->setChecked(value.toBool());
                                   announce();
                                 }));
    });
    fields_.push_back(field);
  }
}

void ParameterForm::edit(ParameterField& field, const std::optional<QString>& text) {
  const QString key = QStringLiteral("%1.%2").arg(quintptr(this)).arg(QString::fromStdString(field.parameter().name));
  undo_.push(new EditCommand(tr("change %1").arg(labelOf(field.parameter())), key, field.visit(),
                             toVariant(field.text()), toVariant(text), [this, &field](const QVariant& value) {
                               field.setText(fromVariant(value));
                               announce();
                             }));
}

void ParameterForm::setValues(const Values& values) {
  undeclared_ = values;
  for (ParameterField* field : fields_) {
    const auto found = undeclared_.find(field->parameter().name);
    field->setText(found == undeclared_.end() ? std::nullopt
                                              : std::optional(fieldText(field->parameter(), found->second)));
    if (found != undeclared_.end()) undeclared_.erase(found);
  }
  announce();
}

Values ParameterForm::values() const {
  Values values = undeclared_;
  for (const ParameterField* field : fields_)
    if (const auto value = field->value(); field->text() && value) values[field->parameter().name] = *value;
  return values;
}

std::map<std::string, QString> ParameterForm::refused() const {
  std::map<std::string, QString> texts;
  for (const ParameterField* field : fields_)
    if (!field->value()) texts[field->parameter().name] = *field->text();
  return texts;
}

void ParameterForm::setTexts(const std::map<std::string, QString>& texts) {
  for (ParameterField* field : fields_)
    if (const auto found = texts.find(field->parameter().name); found != texts.end()) field->setText(found->second);
  announce();
}

bool ParameterForm::isValid() const {
  return std::all_of(fields_.begin(), fields_.end(), [](const auto* field) { return field->value().has_value(); });
}

QStringList ParameterForm::problems() const {
  QStringList problems;
  for (const ParameterField* field : fields_)
    if (const QString problem = field->problem(); !problem.isEmpty())
      problems << labelOf(field->parameter()) + QStringLiteral(": ") + problem;
  return problems;
}

void ParameterForm::setChecked(const std::set<std::string>& names) {
  for (ParameterField* field : fields_) field->setChecked(names.count(field->parameter().name) > 0);
  announce();
}

std::set<std::string> ParameterForm::checked() const {
  std::set<std::string> names;
  for (const ParameterField* field : fields_)
    if (field->isChecked()) names.insert(field->parameter().name);
  return names;
}

void ParameterForm::setShown(const std::set<std::string>& names) {
  shown_ = names;
  filter(search_->text());
}

void ParameterForm::setReadOnly(bool readOnly) {
  for (ParameterField* field : fields_) field->setReadOnly(readOnly);
}

int ParameterForm::changedCount() const {
  return int(
      std::count_if(fields_.begin(), fields_.end(), [](const auto* field) { return field->differsFromDefault(); }));
}

void ParameterForm::resetAll() {
  if (changedCount() == 0) return;
  undo_.beginMacro(tr("reset to defaults"));
  for (ParameterField* field : fields_)
    if (field->differsFromDefault()) edit(*field, std::nullopt);
  undo_.endMacro();
}

ParameterField* ParameterForm::field(const std::string& name) const {
  for (ParameterField* field : fields_)
    if (field->parameter().name == name) return field;
  return nullptr;
}

void ParameterForm::announce() {
  emit changed(values());
  if (const bool valid = isValid(); valid != wasValid_) {
    wasValid_ = valid;
    emit validChanged(valid);
  }
}

void ParameterForm::filter(const QString& text) {
  bool any = false;
  for (ParameterField* field : fields_) {
    const bool matches = shows(field->parameter().name) && field->matches(text.trimmed());
    field->setVisible(matches);
    any = any || matches;
  }
  nothing_->setVisible(!any && !fields_.empty());
}

}  // namespace btr::ui

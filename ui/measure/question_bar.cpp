#include "ui/measure/question_bar.h"

#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "ui/common/look/theme.h"

namespace btr::ui {

QuestionBar::QuestionBar(QWidget* parent)
    : QFrame(parent), text_(new QLabel(this)), yes_(new QPushButton(this)), no_(new QPushButton(this)) {
  setObjectName("questionBar");
  text_->setWordWrap(true);
  text_->setTextFormat(Qt::PlainText);
  yes_->setObjectName("answerYes");
  no_->setObjectName("answerNo");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 6, 6, 6);
  row->addWidget(text_, 1);
  row->addWidget(yes_);
  row->addWidget(no_);
  connect(yes_, &QPushButton::clicked, this, [this] { answer(true); });
  connect(no_, &QPushButton::clicked, this, [this] { answer(false); });
  hide();
}

void QuestionBar::ask(const QString& text, const QString& yes, const QString& no) {
  text_->setText(text);
  setAccessibleName(text);
  yes_->setText(yes);
  no_->setText(no);
  const QColor tone = tonesOf(QGuiApplication::palette()).warning;
  setStyleSheet(QStringLiteral("#questionBar { border: 1px solid %1; border-left: 4px solid %1; border-radius: 4px; }")
                    .arg(tone.name()));
  show();
  no_->setFocus();
}

void QuestionBar::withdraw() { hide(); }

QString QuestionBar::text() const { return text_->text(); }

void QuestionBar::answer(bool yes) {
  hide();
  emit answered(yes);
}

}  // namespace btr::ui

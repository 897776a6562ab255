#include "ui/common/look/message_banner.h"

#include <QEvent>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/common/look/theme.h"

namespace btr::ui {

MessageBanner::MessageBanner(QWidget* parent) : QFrame(parent), icon_(new QLabel(this)), text_(new QLabel(this)) {
  setObjectName("messageBanner");
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  text_->setTextFormat(Qt::PlainText);
  auto* close = new QToolButton(this);
  close->setIcon(themeIcon("dialog-close"));
  close->setAutoRaise(true);
  close->setToolTip(tr("Close this message"));
  close->setAccessibleName(tr("Close this message"));
  connect(close, &QToolButton::clicked, this, &MessageBanner::clear);

  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(10, 6, 6, 6);
  row->addWidget(icon_);
  row->addWidget(text_, 1);
  row->addWidget(close);
  hide();
}

void MessageBanner::showMessage(Kind kind, const QString& text) {
  kind_ = kind;
  text_->setText(text);
  setAccessibleName(text);
  paint();
  show();
  emit shown();
}

void MessageBanner::clear() {
  text_->clear();
  hide();
  emit cleared();
}

QString MessageBanner::text() const { return text_->text(); }

void MessageBanner::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange && !text().isEmpty()) paint();
  QFrame::changeEvent(event);
}

void MessageBanner::paint() {
  // Our own palette follows the style sheet that is set below; judged by it, light and dark would alternate without
  // end.
  const Tones tones = tonesOf(QGuiApplication::palette());
  const QColor tone = kind_ == Kind::error ? tones.bad : kind_ == Kind::warning ? tones.warning : tones.accent;
  const QString name = kind_ == Kind::error     ? QStringLiteral("dialog-error")
                       : kind_ == Kind::warning ? QStringLiteral("dialog-warning")
                                                : QStringLiteral("dialog-information");
  icon_->setPixmap(themeIcon(name).pixmap(22, 22));
  const QString sheet = QStringLiteral(
                            "#messageBanner { border: 1px solid %1; border-left: 4px solid %1; border-radius: 4px; "
                            "background: rgba(%2, %3, %4, 38); }")
                            .arg(tone.name())
                            .arg(tone.red())
                            .arg(tone.green())
                            .arg(tone.blue());
  if (styleSheet() != sheet) setStyleSheet(sheet);
}

}  // namespace btr::ui

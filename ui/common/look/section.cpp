#include "ui/common/look/section.h"

#include <QToolButton>
#include <QVBoxLayout>

#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {
constexpr int least = 60;  // pixels: an arrow and the beginning of the title
constexpr int arrow = 32;  // pixels: the arrow with its margins
}  // namespace

Section::Section(const QString& title, QWidget* content, QWidget* parent)
    : QWidget(parent), title_(title), whole_(title), header_(new QToolButton(this)), content_(content) {
  header_->setText(title);
  header_->setAccessibleName(title);
  header_->setCheckable(true);
  header_->setChecked(true);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setArrowType(Qt::DownArrow);
  header_->setAutoRaise(true);
  header_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  header_->setStyleSheet(
      "QToolButton { font-weight: 600; text-align: left; border: none; border-bottom: 1px solid palette(mid); padding: "
      "5px 2px; }"
      "QToolButton:focus { border-bottom: 1px solid palette(highlight); }");
  connect(header_, &QToolButton::toggled, this, [this](bool open) {
    header_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    content_->setVisible(open);
  });
  header_->setMinimumWidth(least);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 4);
  column->setSpacing(2);
  column->addWidget(header_);
  column->addWidget(content_);
}

void Section::setOpen(bool open) { header_->setChecked(open); }
bool Section::isOpen() const { return header_->isChecked(); }
void Section::setSummary(const QString& summary) {
  whole_ = summary.isEmpty() ? title_ : title_ + QStringLiteral("  ·  ") + summary;
  showTitle();
}

void Section::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  showTitle();
}

// Before it is laid out its width says nothing.
void Section::showTitle() {
  const int room = width() - arrow;
  const bool fits = !isVisible() || header_->fontMetrics().horizontalAdvance(whole_) <= room;
  header_->setText(inMenu(fits ? whole_ : header_->fontMetrics().elidedText(whole_, Qt::ElideRight, room)));
  header_->setToolTip(fits ? QString() : whole_);
  header_->setAccessibleName(whole_);
}

}  // namespace btr::ui

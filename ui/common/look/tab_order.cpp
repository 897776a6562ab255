#include "ui/common/look/tab_order.h"

#include <QLayout>
#include <QList>
#include <QWidget>

namespace btr::ui {
namespace {

void collect(QLayout& layout, QList<QWidget*>& fields) {
  for (int i = 0; i < layout.count(); ++i) {
    QLayoutItem* item = layout.itemAt(i);
    if (QLayout* inside = item->layout()) {
      collect(*inside, fields);
    } else if (QWidget* widget = item->widget()) {
      if (widget->focusPolicy() & Qt::TabFocus) fields << widget;
      if (QLayout* own = widget->layout()) collect(*own, fields);
    }
  }
}

}  // namespace

void orderTabs(QWidget& page) {
  QList<QWidget*> fields;
  if (page.layout()) collect(*page.layout(), fields);
  for (qsizetype i = 1; i < fields.size(); ++i) QWidget::setTabOrder(fields[i - 1], fields[i]);
}

}  // namespace btr::ui

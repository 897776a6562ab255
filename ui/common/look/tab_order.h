#pragma once
class QWidget;

namespace btr::ui {

/// Tab goes through the fields of a page as they stand in its layouts, whatever the order in which they were made.
void orderTabs(QWidget& page);

}  // namespace btr::ui

#pragma once
#include <QStringList>

class QTableWidget;

namespace btr::ui {

/// Makes it a table that is read, not written: these columns, each as wide as its content, one row chosen at a time, no
/// grid, no row numbers.
void setUpForReading(QTableWidget& table, const QStringList& headers);

}  // namespace btr::ui

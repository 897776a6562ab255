#include "ui/common/database/reading_table.h"

#include <QHeaderView>
#include <QTableWidget>

namespace btr::ui {

void setUpForReading(QTableWidget& table, const QStringList& headers) {
  table.setColumnCount(int(headers.size()));
  table.setHorizontalHeaderLabels(headers);
  table.verticalHeader()->hide();
  table.verticalHeader()->setDefaultSectionSize(table.fontMetrics().height() + 8);
  table.setEditTriggers(QAbstractItemView::NoEditTriggers);
  table.setSelectionBehavior(QAbstractItemView::SelectRows);
  table.setSelectionMode(QAbstractItemView::SingleSelection);
  table.setShowGrid(false);
  table.setAlternatingRowColors(true);
  table.setFrameShape(QFrame::NoFrame);
  table.horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table.horizontalHeader()->setHighlightSections(false);
}

}  // namespace btr::ui

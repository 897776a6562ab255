#pragma once
#include <QObject>
#include <vector>

#include "ui/controllers/workbench.h"

namespace btr::ui {
class ComparePage;

/// Runs side by side: the page is filled from the database that is open.
class CompareController : public QObject {
  Q_OBJECT
 public:
  CompareController(Workbench& bench, ComparePage& page);
  /// Ticks these runs beside those that are ticked already.
  void compare(const std::vector<Id>& runs);

 private:
  void read(const std::vector<Id>& runs);

  Workbench& bench_;
  ComparePage& page_;
};

}  // namespace btr::ui

#pragma once
#include <QListWidget>
#include <vector>

#include "ui/live/panels/things_to_add.h"

namespace btr::ui {

/// What can be dragged into the view; Return or a double click adds it in the middle.
class ThingPalette : public QListWidget {
  Q_OBJECT
 public:
  explicit ThingPalette(QWidget* parent = nullptr);
  const ThingToAdd& thing(int index) const { return things_.at(std::size_t(index)); }
  int count() const { return int(things_.size()); }

 signals:
  void chosen(int thing);

 protected:
  QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override;
  void changeEvent(QEvent* event) override;

 private:
  std::vector<ThingToAdd> things_;
};

}  // namespace btr::ui

#pragma once
#include <QWidget>
#include <vector>

#include "ui/live/signal_record.h"

class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace btr::ui {

/// The signals of a world by object and part, with a box each and a field to find them.
class SignalPicker : public QWidget {
  Q_OBJECT
 public:
  static constexpr std::size_t most = 20;

  explicit SignalPicker(QWidget* parent = nullptr);
  /// Those that were chosen stay chosen where they still exist; with `keepGone` also of objects that went: they are
  /// there as long as they are chosen, and go on when their object comes back.
  void setSignals(std::vector<Signal> wanted, bool keepGone);
  /// In the order in which they were chosen.
  const std::vector<Signal>& chosen() const { return chosen_; }
  /// False, with nothing changed, for what does not exist or would be one too many.
  bool choose(const std::string& name, bool on);

 signals:
  void chosenChanged();
  void tooMany();

 private:
  void fill();
  void filter(const QString& text);
  void check(QTreeWidgetItem* item);
  const Signal* find(const std::string& name) const;

  bool isGone(const Signal& signal) const;

  std::vector<Signal> all_, chosen_;
  QLineEdit* search_;
  QTreeWidget* tree_;
};

}  // namespace btr::ui

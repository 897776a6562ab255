#pragma once
#include <QDialog>
#include <vector>

#include "core/live/game.h"
#include "core/store/records.h"

class QComboBox;
class QDialogButtonBox;
class QLabel;
class QTableWidget;

namespace btr {
class PluginHost;
}
namespace btr::ui {
class DatabaseReader;

/// Chooses a stored individual of the open database, to play as a controller: a run, then one of its best.
class IndividualDialog : public QDialog {
  Q_OBJECT
 public:
  static constexpr int most = 100;  ///< individuals that are listed

  IndividualDialog(DatabaseReader& reader, const PluginHost& host, QWidget* parent = nullptr);

 signals:
  void chosen(const btr::GameController& controller);

 private:
  void askRuns();
  void askIndividuals();
  void fill(const std::vector<IndividualRecord>& individuals);
  void choose();
  void say(const QString& why);

  DatabaseReader& reader_;
  const PluginHost& host_;
  std::vector<RunRecord> runs_;
  std::vector<IndividualRecord> individuals_;
  QComboBox* run_;
  QTableWidget* table_;
  QLabel* message_;
  QDialogButtonBox* buttons_;
};

}  // namespace btr::ui

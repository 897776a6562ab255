#pragma once
#include <QWidget>
#include <memory>

#include "core/gap/search/gap_report.h"

class QComboBox;
class QLabel;
class QPushButton;
class QTabWidget;
class QTextBrowser;

namespace btr {
struct ReportLead;
}
namespace btr::ui {
class CalibratedTable;
class EffectsTable;
class ErrorsTable;
class HeatMap;
class PlotWidget;
class StepsTable;

/// A gap report to look through: what was found and what to do (the same as the first screen of report.html), map of
/// the error with the overlay of the chosen channel, error step by step, regimes, effects tried, calibrated numbers,
/// remainder, next recording.
class ReportView : public QWidget {
  Q_OBJECT
 public:
  explicit ReportView(QWidget* parent = nullptr);

  /// Null empties it.
  void setReport(std::shared_ptr<const GapReport> report);
  const std::shared_ptr<const GapReport>& report() const { return report_; }

  HeatMap& map() { return *map_; }
  PlotWidget& overlay() { return *overlay_; }
  PlotWidget& ladder() { return *ladder_; }
  PlotWidget& regimes() { return *regimes_; }
  PlotWidget& remainder() { return *remainder_; }
  PlotWidget& next() { return *next_; }
  EffectsTable& effects() { return *effects_; }
  QTabWidget& tabs() { return *tabs_; }
  std::optional<double> cursor() const { return cursor_; }

 signals:
  /// A place in a trial was chosen: other views may go there.
  void timeChosen(std::size_t trial, double time_s);
  void saveNextRequested();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QWidget* makeFindings();
  QWidget* makeWhere();
  void showFindings(const ReportLead& lead);
  QWidget* makeRegimes();
  QWidget* makeNext();
  void showVerdict();
  void follow(PlotWidget& other, const PlotWidget& moved);
  void showChannel(std::size_t trial, std::size_t series, std::optional<double> time_s);
  void fillChoices();

  std::shared_ptr<const GapReport> report_;
  std::optional<double> cursor_;
  QLabel *headline_, *sentence_, *notes_, *remainderText_, *nextText_;
  QTabWidget* tabs_;
  QTextBrowser* findings_;
  PlotWidget* picture_;
  StepsTable* steps_;
  QComboBox *which_, *channel_, *located_;
  HeatMap* map_;
  PlotWidget *overlay_, *error_, *ladder_, *regimes_, *remainder_, *next_;
  EffectsTable* effects_;
  CalibratedTable* calibrated_;
  ErrorsTable* errors_;
  QPushButton* saveNext_;
};

}  // namespace btr::ui

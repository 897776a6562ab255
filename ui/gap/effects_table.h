#pragma once
#include <QTableWidget>

#include "core/gap/search/gap_report.h"

namespace btr::ui {

/// Every effect that was tried: accepted ones first and bold, rejected ones with the reason.
class EffectsTable : public QTableWidget {
  Q_OBJECT
 public:
  enum Column { effect, at, verdict, reason, gain, pValue, qValue, rank, rivals, parameters, columns };
  explicit EffectsTable(QWidget* parent = nullptr);
  void setReport(const GapReport& report);
};

/// The calibrated numbers: as given, fitted, intervals, remark.
class CalibratedTable : public QTableWidget {
  Q_OBJECT
 public:
  enum Column { name, before, after, interval, amongRivals, unit, remark, columns };
  explicit CalibratedTable(QWidget* parent = nullptr);
  void setReport(const GapReport& report);
};

/// What each channel is off by, in its own unit: cross-validated, and on the recordings that were held out.
class ErrorsTable : public QTableWidget {
  Q_OBJECT
 public:
  enum Column { channel, unit, floor, asGiven, calibrated, withEffects, heldAsGiven, heldCalibrated, heldWithEffects };
  explicit ErrorsTable(QWidget* parent = nullptr);
  void setReport(const GapReport& report);
};

/// The error after each step, numbered as in the chart.
class StepsTable : public QTableWidget {
  Q_OBJECT
 public:
  enum Column { number, step, error, deviation, columns };
  explicit StepsTable(QWidget* parent = nullptr);
  void setReport(const GapReport& report);
};

}  // namespace btr::ui

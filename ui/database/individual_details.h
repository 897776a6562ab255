#pragma once
#include <QWidget>

#include "core/spec/parameter.h"
#include "core/store/records.h"

class QLabel;
class QPlainTextEdit;
class QPushButton;
class QTableWidget;

namespace btr::ui {

/// Everything about one individual: how it did, its chromosome, and its parameters with names, units and ranges.
class IndividualDetails : public QWidget {
  Q_OBJECT

 public:
  explicit IndividualDetails(QWidget* parent = nullptr);
  /// The controller's parameters, in the order of an individual's.
  void setGenotype(const std::vector<Parameter>& genotype);
  void setUnit(const QString& unit);
  void setIndividual(const IndividualRecord& individual, int simulatorNumber, bool fitnessHidden = false);
  void clear();
  Id individual() const { return individual_; }

 signals:
  void replayRequested(btr::Id individual);

 private:
  Id individual_ = 0;
  std::vector<Parameter> genotype_;
  QString unit_;
  QLabel* title_;
  QLabel* facts_;
  QPlainTextEdit* chromosome_;
  QTableWidget* parameters_;
  QPushButton* replay_;
};

/// "01011010 0111…": bits in groups of eight, as the eye counts them.
QString groupedChromosome(const std::string& chromosome);

}  // namespace btr::ui

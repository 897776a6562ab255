#pragma once
#include <QDoubleSpinBox>

namespace btr::ui {

/// A spin box that shows a decimal point whatever the system's language, and reads a comma as one, like every other
/// number of the window.
class DecimalSpinBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  explicit DecimalSpinBox(QWidget* parent = nullptr);

 protected:
  QValidator::State validate(QString& text, int& position) const override;
};

}  // namespace btr::ui

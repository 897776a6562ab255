#pragma once
#include <QAbstractSpinBox>

namespace btr::ui {

/// A number as text in full precision with step buttons. Any text may be typed: whoever owns it judges the text and
/// marks it, because a field that swallows keys does not say what is allowed. The wheel changes it only while it has
/// the focus.
class NumberEdit : public QAbstractSpinBox {
  Q_OBJECT
 public:
  explicit NumberEdit(QWidget* parent = nullptr);
  void setRange(double minimum, double maximum, bool integer);
  QString numberText() const;
  void setNumberText(const QString& text);  ///< keeps the cursor if the text is the same; sends no signal
  void setMarked(bool marked);              ///< the red border of what is not allowed

  void stepBy(int steps) override;
  QSize sizeHint() const override;

 signals:
  void edited(const QString& text);

 protected:
  StepEnabled stepEnabled() const override;
  QValidator::State validate(QString& text, int& position) const override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void showPoint();  ///< once it is left: of a decimal comma, like all that is shown

  double minimum_ = 0, maximum_ = 1;
  bool integer_ = false;
};

}  // namespace btr::ui

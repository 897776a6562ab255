#pragma once
#include <QLabel>

namespace btr::ui {

/// A label for a narrow bar: the whole text where it fits, else a brief form of it, which is never cut; the whole is
/// its tool tip then.
class ShortLabel : public QLabel {
 public:
  using QLabel::QLabel;
  void setTexts(const QString& whole, const QString& brief);
  QString whole() const { return whole_; }
  QSize sizeHint() const override { return sizeOf(whole_); }
  QSize minimumSizeHint() const override { return sizeOf(brief_); }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void choose();
  QSize sizeOf(const QString& text) const;

  QString whole_, brief_;
};

}  // namespace btr::ui

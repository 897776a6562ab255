#pragma once
#include <QLabel>

namespace btr::ui {

/// A label for a narrow place: the whole text where it fits, else a brief form of it, which is never cut; the whole is
/// in its tool tip then.
class ShortLabel : public QLabel {
 public:
  using QLabel::QLabel;
  /// `hint`: its tool tip otherwise.
  void setTexts(const QString& whole, const QString& brief, const QString& hint = {});
  void setTexts(const QString& whole) { setTexts(whole, whole); }
  QString whole() const { return whole_; }
  QSize sizeHint() const override { return sizeOf(whole_); }
  QSize minimumSizeHint() const override { return sizeOf(brief_); }

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void choose();
  QSize sizeOf(const QString& text) const;

  QString whole_, brief_, hint_;
};

}  // namespace btr::ui

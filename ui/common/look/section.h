#pragma once
#include <QWidget>

class QToolButton;

namespace btr::ui {

/// A titled part of a form that folds. The title may carry a short summary, seen when it is folded too.
class Section : public QWidget {
  Q_OBJECT
 public:
  Section(const QString& title, QWidget* content, QWidget* parent = nullptr);
  void setOpen(bool open);
  bool isOpen() const;
  void setSummary(const QString& summary);
  QWidget* content() const { return content_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void showTitle();

  QString title_, whole_;  // without and with the summary; a title that is too long for its line ends in "…"
  QToolButton* header_;
  QWidget* content_;
};

}  // namespace btr::ui

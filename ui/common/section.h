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

 private:
  QString title_;
  QToolButton* header_;
  QWidget* content_;
};

}  // namespace btr::ui

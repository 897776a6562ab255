#pragma once
#include <QFrame>

class QLabel;
class QPushButton;

namespace btr::ui {

/// A question in the page, below the rows that it is about: the values stay in sight and can be corrected instead of
/// answering. Nothing is blocked; ask() with another question replaces the one before.
class QuestionBar : public QFrame {
  Q_OBJECT
 public:
  explicit QuestionBar(QWidget* parent = nullptr);
  /// The button that changes nothing has the focus.
  void ask(const QString& text, const QString& yes, const QString& no);
  void withdraw();
  bool isAsking() const { return !isHidden(); }
  QString text() const;
  QPushButton* yes() const { return yes_; }
  QPushButton* no() const { return no_; }

 signals:
  void answered(bool yes);

 private:
  void answer(bool yes);
  QLabel* text_;
  QPushButton *yes_, *no_;
};

}  // namespace btr::ui

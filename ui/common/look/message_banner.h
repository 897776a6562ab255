#pragma once
#include <QFrame>

class QLabel;

namespace btr::ui {

/// One clear message above the work, with an icon and a button that closes it; never blocks. A newer message replaces
/// it.
class MessageBanner : public QFrame {
  Q_OBJECT
 public:
  enum class Kind { information, warning, error };
  explicit MessageBanner(QWidget* parent = nullptr);
  void showMessage(Kind kind, const QString& text);
  void clear();
  QString text() const;

 signals:
  void shown();
  void cleared();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void paint();
  Kind kind_ = Kind::information;
  QLabel* icon_;
  QLabel* text_;
};

}  // namespace btr::ui

#pragma once
#include <QScrollArea>

namespace btr::ui {

/// The content of a dock: fills it, and is scrolled where the dock is smaller than the content's least size. So no
/// content makes the window grow beyond the screen.
class ScrollPage final : public QScrollArea {
  Q_OBJECT
 public:
  explicit ScrollPage(QWidget* content, QWidget* parent = nullptr);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fit();
};

}  // namespace btr::ui

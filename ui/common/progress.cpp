#include "ui/common/progress.h"

#include <QProgressBar>

#include "ui/common/numbers/format.h"

namespace btr::ui {

double secondsLeft(double share, double elapsed_s) {
  constexpr double least = 0.02;  // before that, one slow start would promise hours
  return share < least || share > 1 || elapsed_s < 0 ? -1 : elapsed_s * (1 - share) / share;
}

void showProgress(QProgressBar& bar, const QString& stage, double share, double elapsed_s) {
  bar.setRange(0, share < 0 ? 0 : 1000);
  bar.setValue(int(share * 1000));
  QString text = QObject::tr("%1 · %p %").arg(QString(stage).replace('%', "%%"));
  if (const double left = secondsLeft(share, elapsed_s); left >= 0)
    text += QObject::tr(" · about %1 left").arg(duration(left));
  bar.setFormat(text);
}

}  // namespace btr::ui

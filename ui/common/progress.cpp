#include "ui/common/progress.h"

#include <QProgressBar>

namespace btr::ui {

void showProgress(QProgressBar& bar, const QString& stage, double share) {
  bar.setRange(0, share < 0 ? 0 : 1000);
  bar.setValue(int(share * 1000));
  bar.setFormat(QObject::tr("%1 · %p %").arg(QString(stage).replace('%', "%%")));
}

}  // namespace btr::ui

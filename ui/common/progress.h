#pragma once
#include <QString>

class QProgressBar;

namespace btr::ui {

/// "fitting · 37 %": what a process does and its share that is done, 0 … 1; negative: not known, the bar runs.
void showProgress(QProgressBar& bar, const QString& stage, double share);

}  // namespace btr::ui

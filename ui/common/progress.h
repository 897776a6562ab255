#pragma once
#include <QString>

class QProgressBar;

namespace btr::ui {

/// "fitting · 37 % · about 2 min 10 s left": what a process does, its share that is done, 0 … 1 (negative: not known,
/// the bar runs), and how long the rest takes at the pace so far; `elapsed_s` negative: nothing is said of that.
void showProgress(QProgressBar& bar, const QString& stage, double share, double elapsed_s = -1);
/// Of something that took `elapsed_s` for this share; negative where nothing can be told yet.
double secondsLeft(double share, double elapsed_s);

}  // namespace btr::ui

#include "ui/common/manual.h"

#include <QCoreApplication>
#include <QDesktopServices>
#include <QDir>
#include <QFileInfo>
#include <QHash>
#include <QObject>
#include <QUrl>
#include <QWidget>

namespace btr::ui {

QString Manual::standardFolder() {
  return QDir::cleanPath(QCoreApplication::applicationDirPath() + "/../share/uchilsim/manual");
}

QString Manual::pageFor(const QWidget* widget) {
  static const QHash<QString, QString> pages{{"dock.tree", "first-run.html"},
                                             {"dock.start", "first-run.html"},
                                             {"dock.run", "first-run.html"},
                                             {"dock.draft", "experiments.html"},
                                             {"dock.spec", "experiments.html"},
                                             {"dock.grid", "experiments.html#the-whole-kick"},
                                             {"dock.live", "scenes-and-robots.html#a-running-world"},
                                             {"dock.sheet", "measuring.html"},
                                             {"dock.policies", "measuring.html#learning-in-reality"},
                                             {"dock.fitness", "charts.html"},
                                             {"dock.gap", "charts.html#reality-gap"},
                                             {"dock.simulators", "charts.html#simulators"},
                                             {"dock.individuals", "charts.html#individuals"},
                                             {"dock.replay", "charts.html#replay"},
                                             {"dock.compare", "charts.html#comparing-runs"},
                                             {"dock.analysis", "gap-analysis.html"}};
  for (; widget; widget = widget->parentWidget())
    if (const auto page = pages.find(widget->objectName()); page != pages.end()) return *page;
  return "index.html";
}

QString Manual::open(const QString& page) const {
  const QString file = folder_ + '/' + page.section('#', 0, 0);
  if (!QFileInfo(file).isFile())
    return QObject::tr("The manual is not there: %1 was looked for. The build makes it with pandoc.").arg(file);
  QUrl url = QUrl::fromLocalFile(file);
  url.setFragment(page.section('#', 1));
  if (!QDesktopServices::openUrl(url))
    return QObject::tr("No program shows web pages here; the manual is %1").arg(file);
  return {};
}

}  // namespace btr::ui

#pragma once
#include <QObject>
#include <QStringList>

class QWidget;

namespace btr::ui {

/// Files that are dropped on the window, or given otherwise: told by their content what they are, and passed on.
class FileDrops : public QObject {
  Q_OBJECT
 public:
  explicit FileDrops(QWidget& window);
  void open(const QStringList& paths);

 signals:
  void databaseGiven(const QString& file);
  void experimentGiven(const QString& file);
  void sceneGiven(const QString& file);
  void gameGiven(const QString& file);
  void sessionGiven(const QString& file);  ///< the log of one
  void robotGiven(const QString& file);
  void recordingsGiven(const QStringList& files);
  void reportGiven(const QString& folder);
  void refused(const QString& why);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace btr::ui

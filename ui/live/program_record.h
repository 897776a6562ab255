#pragma once
#include <QObject>
#include <QString>
#include <deque>
#include <map>

#include "ui/live/drawn/live_scene.h"

namespace btr::ui {
class LiveWorld;

/// What the programs of a world's robots said so far, and whether they run. Keeps what a console shows while none is
/// shown.
class ProgramRecord : public QObject {
  Q_OBJECT
 public:
  explicit ProgramRecord(LiveWorld& world, QObject* parent = nullptr);

  static constexpr std::size_t mostLines = 5000;  ///< older ones are forgotten
  const std::deque<ProgramLine>& lines() const { return lines_; }
  /// By robot: "" it runs, else why no longer.
  const std::map<std::string, QString>& states() const { return states_; }

 signals:
  void said(const btr::ui::ProgramLine& line);
  void statesChanged();
  void cleared();
  /// The first program of this world.
  void began();
  /// It was not asked to end.
  void ended(const QString& robot, const QString& why);

 private:
  void take();

  LiveWorld& world_;
  std::deque<ProgramLine> lines_;
  std::map<std::string, QString> states_;
};

}  // namespace btr::ui

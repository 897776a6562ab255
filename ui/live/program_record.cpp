#include "ui/live/program_record.h"

#include "ui/live/live_world.h"

namespace btr::ui {

ProgramRecord::ProgramRecord(LiveWorld& world, QObject* parent) : QObject(parent), world_(world) {
  connect(&world, &LiveWorld::rowChanged, this, &ProgramRecord::take);
  connect(&world, &LiveWorld::forgotten, this, [this] {
    lines_.clear();
    states_.clear();
    emit cleared();
    emit statesChanged();
  });
}

void ProgramRecord::take() {
  const LiveRow& row = world_.row();
  for (const ProgramLine& line : row.console) {
    lines_.push_back(line);
    if (lines_.size() > mostLines) lines_.pop_front();
    emit said(line);
  }
  if (!row.programs) return;
  const auto before = std::exchange(states_, *row.programs);
  emit statesChanged();
  if (before.empty() && !states_.empty()) emit began();
  for (const auto& [robot, why] : states_)
    if (const auto was = before.find(robot); !why.isEmpty() && (was == before.end() || was->second.isEmpty()))
      emit ended(QString::fromStdString(robot), why);
}

}  // namespace btr::ui

#pragma once
#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <vector>

#include "ui/scene3d/playback.h"
#include "ui/scene3d/replay_data.h"
#include "ui/scene3d/scene_view.h"

class QComboBox;
class QHBoxLayout;
class QLabel;
class QSlider;
class QToolButton;

namespace btr::ui {

class CutLabel;
class ReplayJob;

/// What the badge says of a replay: green identical, red with both fitnesses, grey not checked.
Badge checkBadge(const ReplayData& data);
/// That, and what else a viewer must know: a stand-in's reality, a robot that nobody can see.
QList<Badge> badgesOf(const ReplayData& data);

/// A second replay shown through the first one, at the same time of its own trace.
struct GhostReplay {
  ReplayData data;
  QColor colour{60, 130, 230, 110};
};

/// The 3D view with a transport bar: play and pause (Space), scrub, one frame back and on (left, right), first and last
/// frame (Home, End), loop (L), speed. Shows one replay at a time; the replay itself is made elsewhere, see ReplayJob.
class ReplayPanel : public QWidget {
  Q_OBJECT

 public:
  explicit ReplayPanel(QWidget* parent = nullptr, GlContextFactory factory = createGlContext);
  ~ReplayPanel() override;

  /// Starts at the first frame, paused. A trace that cannot be shown becomes a message in the view.
  void setReplay(const ReplayData& replay);
  void setGhosts(const std::vector<GhostReplay>& ghosts);
  /// Empty again, with a sentence for the user.
  void showMessage(const QString& text, Badge::Tone tone = Badge::Tone::neutral);
  /// Shows what the job delivers, and that it is busy meanwhile.
  void attach(ReplayJob& job);

  SceneView& view() { return *view_; }
  SceneView* besideView() { return beside_; }  ///< null until a pair was shown
  const Playback& playback() const { return playback_; }
  void setPlaying(bool playing);
  void setSpeed(double speed);  ///< one of speeds()
  static const std::vector<double>& speeds();
  /// What the timer does while playing: that much time went by [s].
  void advance(double elapsed_s);
  void step(int frames);
  void showFrame(std::size_t frame);
  void showTime(double time_s);  ///< paused; nothing happens while there is no replay

 signals:
  /// Another frame is shown: its time in the trace [s].
  void timeChanged(double time_s);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QLayout* makeTransport();
  void refresh();
  void refreshCaption();
  void showBeside(const ReplayData* other);
  bool isBeside() const { return beside_ && data_.beside && besideFrames_.times().size() > 0; }

  GlContextFactory factory_;
  SceneView* view_;
  SceneView* beside_ = nullptr;  ///< made for the first pair
  QHBoxLayout* views_;
  QToolButton *first_, *back_, *play_, *forward_, *loop_;
  QSlider* slider_;
  QComboBox* speed_;
  QLabel* time_;
  CutLabel* result_;  ///< what is played, and its fitness
  Playback playback_;
  ReplayData data_;
  ReplayFrames frames_, besideFrames_;
  std::vector<std::pair<ReplayFrames, QColor>> ghosts_;
  QTimer timer_;
  QElapsedTimer since_;
};

}  // namespace btr::ui

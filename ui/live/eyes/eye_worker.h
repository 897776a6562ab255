#pragma once
#include <QImage>
#include <QMetaType>
#include <QMutex>
#include <QThread>
#include <QWaitCondition>
#include <functional>

#include "ui/live/eyes/live_eye.h"

namespace btr::ui {

/// A frame as the panel shows it.
struct ShownFrame {
  enum class What { picture, classes, depth, objects };
  QImage image;  ///< null: the camera does not give that
  std::uint64_t number = 0;
  double time_s = 0;
  double took_ms = 0;            ///< to render and to process it
  std::vector<SeenObject> seen;  ///< the ground is left out
  std::vector<QString> names;    ///< of those
};

/// Renders and processes a robot's camera on a thread of its own, so that the window never waits for it. Frames that
/// come too late are left out. Rows and settings may come from any thread; the newest count.
class EyeWorker : public QThread {
  Q_OBJECT
 public:
  explicit EyeWorker(QObject* parent = nullptr);
  /// Waits for the frame that is being made.
  ~EyeWorker() override;

  /// Makes the eye in the worker's thread; what it throws as InputError comes as failed().
  void look(std::function<std::unique_ptr<LiveEye>()> make);
  /// The same eye through another camera.
  void setCamera(const CameraSpec& camera);
  void setWhat(ShownFrame::What what);
  void add(const LiveRow& row);

 signals:
  void shown(const btr::ui::ShownFrame& frame);
  void failed(const QString& why);

 protected:
  void run() override;

 private:
  QMutex mutex_;
  QWaitCondition news_;
  std::function<std::unique_ptr<LiveEye>()> make_;
  std::optional<CameraSpec> camera_;
  std::vector<LiveRow> rows_;
  ShownFrame::What what_ = ShownFrame::What::picture;
  bool again_ = false;  ///< the same frame once more, shown otherwise
  bool ends_ = false;
};

/// A frame as people see it: the picture, the colour classes, depth as grey (black 0, white 3 m), or objects by colour.
QImage imageOf(const CameraFrame& frame, ShownFrame::What what);

}  // namespace btr::ui

Q_DECLARE_METATYPE(btr::ui::ShownFrame)

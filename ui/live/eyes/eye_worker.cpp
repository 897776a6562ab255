#include "ui/live/eyes/eye_worker.h"

#include <QElapsedTimer>
#include <QMutexLocker>
#include <algorithm>
#include <cmath>

#include "core/camera/picture_file.h"
#include "core/spec/error.h"

namespace btr::ui {
namespace {

constexpr std::size_t mostRows = 250;  ///< that wait: more than a slow frame takes
constexpr double whiteDepth_m = 3;

QImage toImage(int width, int height, const std::vector<std::uint8_t>& rgb) {
  if (rgb.empty()) return {};
  return QImage(rgb.data(), width, height, 3 * width, QImage::Format_RGB888).copy();
}

QImage depthImage(const CameraFrame& frame) {
  QImage image(frame.width, frame.height, QImage::Format_Grayscale8);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const double depth = frame.truth.depth_m[static_cast<std::size_t>(y * frame.width + x)];
      image.scanLine(y)[x] = static_cast<uchar>(std::lround(255 * std::min(1.0, depth / whiteDepth_m)));
    }
  return image;
}

QImage objectImage(const CameraFrame& frame) {
  QImage image(frame.width, frame.height, QImage::Format_RGB32);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const int object = frame.truth.object[static_cast<std::size_t>(y * frame.width + x)];
      constexpr int golden = 137;  // degrees: neighbours in number are far apart in hue
      image.setPixelColor(x, y,
                          object == 0   ? QColor(Qt::black)
                          : object == 1 ? QColor(Qt::darkGray)
                                        : QColor::fromHsv(golden * object % 360, 200, 235));
    }
  return image;
}

ShownFrame toShown(const EyeFrame& frame, const std::vector<std::string>& objects, ShownFrame::What what) {
  ShownFrame shown;
  shown.image = imageOf(frame.picture, what);
  shown.number = frame.number;
  shown.time_s = frame.time_s;
  for (const SeenObject& seen : frame.picture.truth.seen) {
    if (seen.object == SceneBuilder::groundNumber()) continue;
    shown.seen.push_back(seen);
    shown.names.push_back(QString::fromStdString(objects.at(seen.object - 1u)));
  }
  return shown;
}

}  // namespace

QImage imageOf(const CameraFrame& frame, ShownFrame::What what) {
  switch (what) {
    case ShownFrame::What::picture:
      return toImage(frame.width, frame.height, shownRgb(frame));
    case ShownFrame::What::classes:
      return frame.classes.empty()
                 ? QImage()
                 : toImage(frame.width, frame.height, classPicture(frame.width, frame.height, frame.classes).rgb);
    case ShownFrame::What::depth:
      return depthImage(frame);
    case ShownFrame::What::objects:
      return objectImage(frame);
  }
  return {};
}

EyeWorker::EyeWorker(QObject* parent) : QThread(parent) { qRegisterMetaType<ShownFrame>(); }

EyeWorker::~EyeWorker() {
  {
    const QMutexLocker lock(&mutex_);
    ends_ = true;
  }
  news_.wakeAll();
  wait();
}

void EyeWorker::look(std::function<std::unique_ptr<LiveEye>()> make) {
  {
    const QMutexLocker lock(&mutex_);
    make_ = std::move(make);
    camera_.reset();
    rows_.clear();
  }
  if (!isRunning()) start();
  news_.wakeAll();
}

void EyeWorker::setCamera(const CameraSpec& camera) {
  {
    const QMutexLocker lock(&mutex_);
    camera_ = camera;
  }
  news_.wakeAll();
}

void EyeWorker::setWhat(ShownFrame::What what) {
  {
    const QMutexLocker lock(&mutex_);
    what_ = what;
    again_ = true;
  }
  news_.wakeAll();
}

void EyeWorker::add(const LiveRow& row) {
  {
    const QMutexLocker lock(&mutex_);
    if (rows_.size() >= mostRows) rows_.erase(rows_.begin());
    rows_.push_back(row);
  }
  news_.wakeAll();
}

void EyeWorker::run() {
  std::unique_ptr<LiveEye> eye;
  std::optional<EyeFrame> last;
  double took_ms = 0;
  bool waits = true;
  for (;;) {
    std::vector<LiveRow> rows;
    std::function<std::unique_ptr<LiveEye>()> make;
    std::optional<CameraSpec> camera;
    ShownFrame::What what;
    bool again;
    {
      QMutexLocker lock(&mutex_);
      while (!ends_ && !make_ && !camera_ && rows_.empty() && !again_) news_.wait(&mutex_);
      if (ends_) return;
      rows = std::exchange(rows_, {});
      make = std::exchange(make_, nullptr);
      camera = std::exchange(camera_, std::nullopt);
      what = what_;
      again = std::exchange(again_, false);
    }
    try {
      if (make) {
        last.reset();
        eye.reset();  // its OpenGL goes before the next one's comes
        eye = make();
      }
      if (!eye) continue;
      if (camera) eye->setCamera(*camera);
      for (const LiveRow& row : rows) eye->add(row);
      eye->catchUp();
      QElapsedTimer watch;
      watch.start();
      // While the world waits, hands still move things.
      if (!rows.empty()) waits = !rows.back().playing;
      if (auto frame = waits && (camera || !rows.empty()) ? eye->still() : eye->next()) {
        last = std::move(frame);
        took_ms = static_cast<double>(watch.nsecsElapsed()) * 1e-6;
        again = true;
      }
      if (!again || !last) continue;
      ShownFrame shownFrame = toShown(*last, eye->objects(), what);
      shownFrame.took_ms = took_ms;
      emit shown(shownFrame);
    } catch (const InputError& error) {
      eye.reset();
      emit failed(QString::fromStdString(error.what()));
    }
  }
}

}  // namespace btr::ui

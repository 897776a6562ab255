#include "ui/charts/plot_widget.h"

#include <QApplication>
#include <QChart>
#include <QChartView>
#include <QClipboard>
#include <QFileDialog>
#include <QGraphicsLayout>
#include <QKeyEvent>
#include <QLocale>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QRubberBand>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>
#include <optional>

#include "core/spec/error.h"
#include "ui/charts/chart_scene.h"
#include "ui/charts/plot_export.h"

namespace btr::ui {

struct PlotWidget::Impl {
  explicit Impl(PlotWidget& widget)
      : self(widget),
        scene(&widget),
        view(new QChartView(scene.chart(), &widget)),
        menu(&widget),
        button(&widget),
        band(new QRubberBand(QRubberBand::Rectangle, view->viewport())) {}

  PlotWidget& self;
  ChartScene scene;
  QChartView* view;
  QMenu menu;
  QToolButton button;
  QRubberBand* band;
  QAction *reset = nullptr, *logarithmic = nullptr;
  bool zoomed = false;
  QPoint pressed, moved;
  std::optional<PlotData> next;  ///< given, but not drawn yet
  enum class Drag { none, zoom, move } drag = Drag::none;

  /// For people; exported tables are exact.
  static QString readable(double value) { return QLocale::c().toString(value, 'g', 6); }

  void showAll() {
    zoomed = false;
    reset->setEnabled(false);
    scene.setRange(scene.fullRange());
    emit self.rangeChanged();
  }
  void zoom(const QRectF& range) {
    if (!(range.width() > 0) || !(range.height() > 0) || !std::isfinite(range.width() + range.height())) return;
    zoomed = true;
    reset->setEnabled(true);
    scene.setRange(range);
    emit self.rangeChanged();
  }
  QPointF valueAt(const QPointF& place) const {
    return scene.toValue(scene.chart()->mapFromScene(view->mapToScene(place.toPoint())));
  }
  bool inPlot(const QPoint& place) const {
    return scene.chart()->plotArea().contains(scene.chart()->mapFromScene(view->mapToScene(place)));
  }
  /// Around a place in the view, in pixels, so that it works on a logarithmic axis too.
  void scale(const QPointF& centre, double factor) {
    const QRectF area = scene.chart()->plotArea();
    const QPointF c = scene.chart()->mapFromScene(view->mapToScene(centre.toPoint()));
    const QPointF low = scene.toValue(c + (area.bottomLeft() - c) * factor);
    const QPointF high = scene.toValue(c + (area.topRight() - c) * factor);
    zoom({low, high});
  }
  void shift(const QPointF& pixels) {
    const QRectF area = scene.chart()->plotArea();
    zoom({scene.toValue(area.bottomLeft() - pixels), scene.toValue(area.topRight() - pixels)});
  }

  std::optional<PlotOverlay::ReadOut> nearest(const QPoint& place) const {
    const QPointF here = scene.chart()->mapFromScene(view->mapToScene(place));
    if (!scene.chart()->plotArea().contains(here)) return {};
    double best = 24;  // pixels
    std::optional<PlotOverlay::ReadOut> found;
    const PlotData& data = scene.data();
    for (const PlotSeries& series : data.series) {
      if (!scene.isShown(series.name)) continue;
      for (std::size_t i = 0; i < series.points.size(); ++i) {
        const QPointF away = scene.toPosition(series.drawnAt(i)) - here;
        const double distance = std::hypot(away.x(), away.y());
        if (!(distance < best)) continue;
        best = distance;
        QString text = series.name.isEmpty() ? QString() : series.name + '\n';
        const QString x = data.xLabels.isEmpty()
                              ? data.xTitle + " = " + readable(series.points[i].x())
                              : data.xTitle + ' ' + data.xLabels.value(std::round(series.points[i].x()));
        text += x + '\n' + data.yTitle + " = " + readable(series.points[i].y());
        if (i < series.errors.size() && series.errors[i] > 0) text += " ± " + readable(series.errors[i]);
        found = PlotOverlay::ReadOut{series.drawnAt(i), text, series.colour};
      }
    }
    return found;
  }

  PlotPicture picture() {
    QChart* chart = scene.chart();
    if (chart->size().isEmpty() || !self.isVisible()) {
      view->resize(self.size());
      chart->resize(self.size());
    }
    chart->layout()->activate();
    const auto paint = [this, chart](QPainter& painter, const QRectF& target) {
      const PlotColours shown = scene.colours();
      scene.setForPrint(true);
      scene.setColours(PlotColours::forPrint());
      chart->layout()->activate();
      scene.tidyLabels();
      view->scene()->render(&painter, target, chart->mapRectToScene(chart->rect()));
      scene.setColours(shown);
      scene.setForPrint(false);
    };
    return {chart->size(), scene.data().title, scene.data().note, paint};
  }
};

PlotWidget::PlotWidget(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>(*this)) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Chart"));
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(impl_->view);
  impl_->view->setFrameShape(QFrame::NoFrame);
  impl_->view->setRenderHint(QPainter::Antialiasing);
  impl_->view->setFocusPolicy(Qt::NoFocus);
  // In parts, pieces of labels that moved stay behind beside the axes.
  impl_->view->setViewportUpdateMode(QGraphicsView::FullViewportUpdate);
  impl_->view->setContextMenuPolicy(Qt::NoContextMenu);
  impl_->view->viewport()->setObjectName("plotArea");
  impl_->view->viewport()->setMouseTracking(true);
  impl_->view->viewport()->installEventFilter(this);

  // The menu of the button and of the right mouse button.
  QMenu& menu = impl_->menu;
  impl_->reset = menu.addAction(tr("Show everything"), this, &PlotWidget::resetZoom);
  impl_->reset->setShortcut(Qt::Key_Home);
  impl_->reset->setShortcutContext(Qt::WidgetShortcut);
  impl_->logarithmic = menu.addAction(tr("Logarithmic axis"));
  impl_->logarithmic->setCheckable(true);
  connect(impl_->logarithmic, &QAction::toggled, this, &PlotWidget::setLogarithmic);
  menu.addSeparator();
  menu.addAction(QIcon::fromTheme("edit-copy"), tr("Copy picture and numbers"), this, &PlotWidget::copyToClipboard);
  menu.addAction(QIcon::fromTheme("document-export"), tr("Export…"), this, &PlotWidget::exportWithDialog);

  QToolButton& button = impl_->button;
  button.setText("☰");
  button.setAutoRaise(true);
  button.setPopupMode(QToolButton::InstantPopup);
  button.setMenu(&menu);
  button.setStyleSheet("QToolButton::menu-indicator { image: none; }");
  button.setToolTip(
      tr("Copy, export, axes.\nDrag or wheel: zoom. Double click or Home: show everything.\n"
         "Click a name in the legend: hide or show it."));
  button.setAccessibleName(tr("Chart menu"));

  connect(&impl_->scene, &ChartScene::shownChanged, this, [this] {
    if (!impl_->zoomed) impl_->showAll();
  });
  impl_->scene.setFont(font());
  impl_->scene.setColours(PlotColours::of(palette()));
  impl_->showAll();
}

PlotWidget::~PlotWidget() {
  // The view's scene holds items that look at our data: it goes first.
  delete impl_->view;
}

void PlotWidget::setData(PlotData data) {
  const bool waiting = impl_->next.has_value();
  impl_->next = std::move(data);
  // One that is not seen is drawn when it is shown.
  if (!waiting && isVisible())
    QMetaObject::invokeMethod(
        this, [this] { settled(); }, Qt::QueuedConnection);
}

PlotWidget::Impl& PlotWidget::settled() const {
  if (!impl_->next) return *impl_;
  PlotData data = std::move(*impl_->next);
  impl_->next.reset();
  impl_->scene.setReadOut({});
  impl_->scene.setData(std::move(data));
  if (impl_->zoomed)
    impl_->scene.setRange(impl_->scene.range());
  else
    impl_->showAll();
  impl_->self.setAccessibleDescription(impl_->scene.data().title + ". " + impl_->scene.data().note);
  return *impl_;
}

const PlotData& PlotWidget::data() const { return impl_->next ? *impl_->next : impl_->scene.data(); }
std::vector<QPointF> PlotWidget::drawnPoints(const QString& series) const {
  return settled().scene.drawnPoints(series);
}
bool PlotWidget::isSeriesShown(const QString& name) const { return settled().scene.isShown(name); }
QStringList PlotWidget::legendNames() const { return settled().scene.legendNames(); }
QRectF PlotWidget::visibleRange() const { return settled().scene.range(); }
void PlotWidget::zoomTo(const QRectF& values) { settled().zoom(values); }
void PlotWidget::resetZoom() { settled().showAll(); }
bool PlotWidget::isZoomed() const { return impl_->zoomed; }
bool PlotWidget::isLogarithmic() const { return impl_->scene.isLogarithmic(); }

void PlotWidget::setSeriesShown(const QString& name, bool shown) {
  settled().scene.setShown(name, shown);
  if (!impl_->zoomed) impl_->showAll();
}

void PlotWidget::setLogarithmic(bool on) {
  impl_->logarithmic->setChecked(on);
  settled().scene.setLogarithmic(on);
  impl_->showAll();
}

QString PlotWidget::readOutAt(const QPoint& place) const {
  const auto found = settled().nearest(impl_->view->viewport()->mapFrom(this, place));
  return found ? found->text : QString();
}

QPoint PlotWidget::placeOf(const QPointF& value) const {
  const ChartScene& scene = settled().scene;
  const QPointF inScene = scene.chart()->mapToScene(scene.toPosition(value));
  return impl_->view->viewport()->mapTo(this, impl_->view->mapFromScene(inScene));
}

void PlotWidget::exportTo(const QString& path) { exportPlot(path, data(), settled().picture()); }

void PlotWidget::copyToClipboard() {
  const PlotPicture picture = settled().picture();
  QImage image((picture.size * 2).toSize(), QImage::Format_ARGB32_Premultiplied);
  image.setDevicePixelRatio(2);
  QPainter painter(&image);
  picture.paint(painter, QRectF({0, 0}, picture.size));
  painter.end();
  auto* content = new QMimeData;
  content->setImageData(image);
  content->setText(QString::fromStdString(toCsv(data())));
  QApplication::clipboard()->setMimeData(content);
}

void PlotWidget::exportWithDialog() {
  const QString path = QFileDialog::getSaveFileName(this, tr("Export chart"), "chart.png", exportFilter());
  if (path.isEmpty()) return;
  try {
    exportTo(path);
  } catch (const InputError& error) {
    QMessageBox::warning(this, tr("Export chart"), QString::fromUtf8(error.what()));
  }
}

bool PlotWidget::eventFilter(QObject* watched, QEvent* event) {
  Impl& d = *impl_;
  if (watched != d.view->viewport()) return QWidget::eventFilter(watched, event);
  // What is painted, and what the mouse is at, is the latest.
  if (event->type() == QEvent::Paint || event->type() == QEvent::MouseButtonPress || event->type() == QEvent::Wheel)
    settled();
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      setFocus(Qt::MouseFocusReason);
      if (!d.inPlot(mouse->pos())) return false;
      d.pressed = d.moved = mouse->pos();
      if (mouse->button() == Qt::LeftButton) d.drag = Impl::Drag::zoom;
      if (mouse->button() == Qt::MiddleButton) d.drag = Impl::Drag::move;
      return d.drag != Impl::Drag::none;
    }
    case QEvent::MouseMove: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      if (d.drag == Impl::Drag::zoom) {
        d.band->setGeometry(QRect(d.pressed, mouse->pos()).normalized());
        d.band->show();
      } else if (d.drag == Impl::Drag::move) {
        d.shift(mouse->pos() - d.moved);
        d.moved = mouse->pos();
      } else {
        d.scene.setReadOut(d.nearest(mouse->pos()));
      }
      return d.drag != Impl::Drag::none;
    }
    case QEvent::MouseButtonRelease: {
      const auto* mouse = static_cast<QMouseEvent*>(event);
      const Impl::Drag drag = std::exchange(d.drag, Impl::Drag::none);
      d.band->hide();
      const QPoint size = mouse->pos() - d.pressed;
      if (drag == Impl::Drag::zoom && std::abs(size.x()) > 4 && std::abs(size.y()) > 4)
        d.zoom(QRectF(d.valueAt(d.pressed), d.valueAt(mouse->pos())).normalized());
      return drag != Impl::Drag::none;
    }
    case QEvent::MouseButtonDblClick:
      if (!d.inPlot(static_cast<QMouseEvent*>(event)->pos())) return false;
      d.drag = Impl::Drag::none;
      resetZoom();
      return true;
    case QEvent::Wheel: {
      const auto* wheel = static_cast<QWheelEvent*>(event);
      if (!d.inPlot(wheel->position().toPoint())) return false;
      d.scale(wheel->position(), std::pow(0.8, wheel->angleDelta().y() / 120.0));
      return true;
    }
    case QEvent::Paint:
      d.scene.tidyLabels();
      return false;
    case QEvent::Leave:
      d.scene.setReadOut({});
      return false;
    default:
      return false;
  }
}

void PlotWidget::keyPressEvent(QKeyEvent* event) {
  settled();
  const QRectF area = impl_->scene.chart()->plotArea();
  const QPointF centre = impl_->view->mapFromScene(impl_->scene.chart()->mapToScene(area.center()));
  switch (event->key()) {
    case Qt::Key_Home:
      resetZoom();
      break;
    case Qt::Key_Plus:
      impl_->scale(centre, 0.8);
      break;
    case Qt::Key_Minus:
      impl_->scale(centre, 1.25);
      break;
    case Qt::Key_Left:
      impl_->shift({area.width() / 10, 0});
      break;
    case Qt::Key_Right:
      impl_->shift({-area.width() / 10, 0});
      break;
    case Qt::Key_Up:
      impl_->shift({0, area.height() / 10});
      break;
    case Qt::Key_Down:
      impl_->shift({0, -area.height() / 10});
      break;
    default:
      QWidget::keyPressEvent(event);
  }
}

void PlotWidget::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) impl_->scene.setColours(PlotColours::of(palette()));
  if (event->type() == QEvent::FontChange) impl_->scene.setFont(font());
  QWidget::changeEvent(event);
}

void PlotWidget::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  const QSize size = impl_->button.sizeHint();
  impl_->button.setGeometry(QRect(QPoint(width() - size.width() - 4, 3), size));
  impl_->button.raise();
}

void PlotWidget::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (impl_->next)
    QMetaObject::invokeMethod(
        this, [this] { settled(); }, Qt::QueuedConnection);
}

void PlotWidget::contextMenuEvent(QContextMenuEvent* event) { impl_->menu.exec(event->globalPos()); }

}  // namespace btr::ui

#include "ui/grid/cube_view.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "core/run/grid/grid_cells.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/grid/ramp.h"

namespace btr::ui {
namespace {

constexpr double legendHeight = 70, leftMargin = 64, topMargin = 26;

/// Alike as drawn ones (0.6) is thin and faint, equal is thick.
QPen edgePen(double similarity, const QPalette& palette, Qt::PenCapStyle cap = Qt::SquareCap) {
  const double strength = std::clamp((similarity - 0.5) / 0.5, 0.0, 1.0);
  QColor colour = palette.color(QPalette::Text);
  colour.setAlphaF(static_cast<float>(0.18 + 0.5 * strength));
  return QPen(colour, 1 + 6 * strength, Qt::SolidLine, cap);
}

}  // namespace

CubeView::CubeView(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Cells of the grid"));
  setMouseTracking(true);
}

void CubeView::setSummary(const GridSummary& summary) {
  const bool same = summary.grid.id == summary_.grid.id;
  summary_ = summary;
  highest_ = 0;
  for (const GridRow& r : summary_.rows) highest_ = std::max(highest_, r.fitness);
  if (highest_ <= 0) highest_ = 1;
  if (!same) slice_ = -1;
  if (!same || !row(current_)) current_ = 0;
  update();
}

void CubeView::setSlice(int index) {
  slice_ = index;
  if (current_ && !shown(current_)) current_ = 0;
  update();
}

const GridRow* CubeView::row(int cell) const {
  const auto found = std::ranges::find(summary_.rows, cell, &GridRow::cell);
  return found == summary_.rows.end() ? nullptr : &*found;
}

std::array<std::size_t, 3> CubeView::indexOf(int cell) const {
  const std::size_t directions = summary_.spec.axes[2].size(), bearings = summary_.spec.axes[1].size();
  const auto k = static_cast<std::size_t>(cell - 1);
  return {k / directions / bearings, k / directions % bearings, k % directions};
}

int CubeView::numberOf(const std::array<std::size_t, 3>& index) const {
  const auto& axes = summary_.spec.axes;
  return static_cast<int>((index[0] * axes[1].size() + index[1]) * axes[2].size() + index[2]) + 1;
}

bool CubeView::shown(int cell) const { return slice_ < 0 || indexOf(cell)[0] == static_cast<std::size_t>(slice_); }

double CubeView::radius() const {
  const auto& axes = summary_.spec.axes;
  const double columns = static_cast<double>(std::max<std::size_t>(axes[1].size(), 1)) + (slice_ < 0 ? 0.7 : 0);
  const double rows = static_cast<double>(std::max<std::size_t>(axes[2].size(), 1)) + (slice_ < 0 ? 0.7 : 0);
  return std::clamp(std::min((width() - leftMargin) / columns, (height() - legendHeight - topMargin) / rows) * 0.24,
                    8.0, 30.0);
}

// The ball's bearing to the left (it lies left of the dog), the target's direction upwards; farther balls behind, that
// is to the right and above.
QPointF CubeView::centreOf(int cell) const {
  const auto index = indexOf(cell);
  const auto& axes = summary_.spec.axes;
  const double wide = width() - leftMargin - 16, high = height() - legendHeight - topMargin - 26;
  const bool all = slice_ < 0 && axes[0].size() > 1;
  const double depth = all ? static_cast<double>(index[0]) / static_cast<double>(axes[0].size() - 1) : 0;
  const double columns = static_cast<double>(axes[1].size()), rows = static_cast<double>(axes[2].size());
  const double stepX = wide / (columns + (all ? 0.55 : 0)), stepY = high / (rows + (all ? 0.55 : 0));
  const double column = columns - 1 - static_cast<double>(index[1]), fromTop = rows - 1 - static_cast<double>(index[2]);
  return {leftMargin + stepX * (column + 0.5 + 0.45 * depth),
          topMargin + stepY * (fromTop + 0.5 + (all ? 0.45 * (1 - depth) : 0))};
}

int CubeView::cellAt(const QPointF& place) const {
  int found = 0;
  double nearest = radius() * 1.2;
  for (const GridRow& r : summary_.rows) {
    const QPointF away = centreOf(r.cell) - place;
    const double distance = std::hypot(away.x(), away.y());
    if (!shown(r.cell) || distance > nearest) continue;
    nearest = distance;
    found = r.cell;
  }
  return found;
}

QString CubeView::describe(int cell) const {
  const GridRow* r = row(cell);
  if (!r) return {};
  const QString unit = QString::fromStdString(summary_.unit);
  QString text =
      tr("Cell %1: %2\nfitness %3, similarity to its neighbours %4")
          .arg(cell)
          .arg(QString::fromStdString(nameOfTask(r->task)), withUnit(r->fitness, unit), shortNumber(r->similarity));
  if (r->mirrorOf) text += tr("\nmirror image of cell %1").arg(r->mirrorOf);
  if (r->sourceTookFrom) text += tr(", which has the solution of cell %1").arg(r->sourceTookFrom);
  if (r->failed) text += tr("\nfailed: its own best was %1").arg(withUnit(r->ownFitness, unit));
  if (r->takenFrom) text += tr("\nhas the solution of cell %1").arg(r->takenFrom);
  if (r->begunAt) text += tr("\nits population began around the best of cell %1").arg(r->begunAt);
  return text + tr("\nrun %1, individual %2").arg(r->run).arg(r->individual);
}

void CubeView::choose(int cell) {
  if (!row(cell) || !shown(cell)) return;
  current_ = cell;
  setAccessibleDescription(describe(cell));
  update();
  emit chosen(cell);
}

void CubeView::paintEdges(QPainter& painter) const {
  for (const GridEdge& edge : summary_.edges) {
    if (!shown(edge.one) || !shown(edge.other)) continue;
    painter.setPen(edgePen(edge.similarity, palette(), Qt::RoundCap));
    painter.drawLine(centreOf(edge.one), centreOf(edge.other));
  }
}

void CubeView::paintCell(QPainter& painter, const GridRow& r) const {
  const QPointF centre = centreOf(r.cell);
  const double size = radius();
  const QColor fill = rampColour(r.fitness / highest_);
  painter.setPen(r.mirrorOf ? QPen(Qt::NoPen) : QPen(palette().color(QPalette::Text), 1.5));
  painter.setBrush(fill);
  painter.drawEllipse(centre, size, size);
  painter.setBrush(Qt::NoBrush);
  if (r.failed) {
    painter.setPen(QPen(tonesOf(palette()).bad, 2.5, r.takenFrom || r.sourceTookFrom ? Qt::DashLine : Qt::SolidLine));
    painter.drawEllipse(centre, size + 4, size + 4);
  }
  painter.setPen(textOn(fill));
  QFont small = font();
  small.setPixelSize(static_cast<int>(std::max(8.0, size * 0.62)));
  painter.setFont(small);
  const QRectF box(centre - QPointF(size, size), QSizeF(2 * size, 2 * size));
  painter.drawText(box, Qt::AlignCenter, QString::number(r.fitness, 'f', 2));
  // The number by which tables and the marks of replaced cells call it.
  QFont tiny = font();
  tiny.setPixelSize(static_cast<int>(std::max(7.0, size * 0.42)));
  painter.setFont(tiny);
  painter.setPen(tonesOf(palette()).muted);
  painter.drawText(QRectF(centre.x() - 2.75 * size, centre.y() + size * 0.65, 1.85 * size, size),
                   Qt::AlignRight | Qt::AlignTop, QString::number(r.cell));
  painter.setFont(small);
  if (r.takenFrom || r.sourceTookFrom) {
    painter.setPen(tonesOf(palette()).bad);
    // In brackets where the cell that it mirrors has taken it.
    painter.drawText(
        QPointF(centre.x() + size * 0.75, centre.y() - size * 0.85),
        r.takenFrom ? QStringLiteral("←%1").arg(r.takenFrom) : QStringLiteral("(←%1)").arg(r.sourceTookFrom));
  }
  if (r.cell == current_) {
    painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Highlight : QPalette::Text), 3));
    painter.drawEllipse(centre, size + 8, size + 8);
  }
  painter.setFont(font());
}

void CubeView::paintAxes(QPainter& painter) const {
  const auto& axes = summary_.spec.axes;
  const int nearest = slice_ < 0 ? 0 : slice_;
  painter.setPen(palette().color(QPalette::Text));
  const auto front = static_cast<std::size_t>(nearest);
  for (std::size_t b = 0; b < axes[1].size(); ++b)
    painter.drawText(QRectF(centreOf(numberOf({front, b, 0})).x() - 60, height() - legendHeight - 24, 120, 20),
                     Qt::AlignCenter, tr("β %1").arg(degrees(axes[1][b])));
  for (std::size_t a = 0; a < axes[2].size(); ++a)
    painter.drawText(QRectF(0, centreOf(numberOf({front, axes[1].size() - 1, a})).y() - 10, leftMargin - 4, 20),
                     Qt::AlignRight | Qt::AlignVCenter, tr("α %1").arg(degrees(axes[2][a])));
  if (slice_ >= 0 || axes[0].size() == 1) return;
  for (std::size_t d = 0; d < axes[0].size(); ++d) {
    const QPointF top = centreOf(numberOf({d, 0, axes[2].size() - 1}));
    painter.drawText(QRectF(top.x() - 70, top.y() - radius() - 24, 140, 18), Qt::AlignCenter,
                     tr("d %1 m").arg(axes[0][d]));
  }
}

void CubeView::paintLegend(QPainter& painter) const {
  const double top = height() - legendHeight + 6, wide = 110;
  double x = 8;
  painter.setPen(palette().color(QPalette::Text));
  for (int i = 0; i < wide; ++i) painter.fillRect(QRectF(x + i, top, 1.5, 12), rampColour(i / wide));
  painter.drawText(QRectF(x - 4, top + 13, wide + 8, 20), Qt::AlignLeft, QStringLiteral("0"));
  painter.drawText(QRectF(x, top + 13, wide, 20), Qt::AlignRight,
                   withUnit(highest_, QString::fromStdString(summary_.unit)));
  x += wide + 22;
  for (const double alike : {0.6, 0.8, 1.0}) {
    painter.setPen(edgePen(alike, palette()));
    painter.drawLine(QPointF(x, top + 6), QPointF(x + 24, top + 6));
    painter.setPen(palette().color(QPalette::Text));
    painter.drawText(QRectF(x - 8, top + 13, 40, 20), Qt::AlignCenter, QString::number(alike));
    x += 44;
  }
  painter.drawText(QRectF(x - 8, top - 4, 120, 20), Qt::AlignLeft | Qt::AlignVCenter, tr("similarity"));
  const double below = top + 36;
  painter.setPen(QPen(tonesOf(palette()).bad, 2.5));
  painter.drawEllipse(QPointF(16, below + 6), 6, 6);
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(QRectF(28, below - 4, width() - 36, 20), Qt::AlignLeft | Qt::AlignVCenter,
                   tr("failed (broken: replaced) · no outline: mirror image"));
}

void CubeView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().base());
  if (summary_.rows.empty()) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("No cell is settled yet: they are when all have learned"));
    return;
  }
  paintEdges(painter);
  paintAxes(painter);
  // Farther slices first.
  for (std::size_t d = summary_.spec.axes[0].size(); d-- > 0;)
    for (const GridRow& r : summary_.rows)
      if (indexOf(r.cell)[0] == d && shown(r.cell)) paintCell(painter, r);
  paintLegend(painter);
}

void CubeView::mousePressEvent(QMouseEvent* event) {
  if (const int cell = cellAt(event->position())) choose(cell);
}

void CubeView::mouseDoubleClickEvent(QMouseEvent* event) {
  if (const int cell = cellAt(event->position())) emit replayRequested(cell);
}

void CubeView::keyPressEvent(QKeyEvent* event) {
  if (summary_.rows.empty()) return QWidget::keyPressEvent(event);
  if (current_ && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter)) {
    emit replayRequested(current_);
    return;
  }
  auto index = indexOf(current_ ? current_ : 1);
  const auto& axes = summary_.spec.axes;
  const auto move = [&](std::size_t axis, bool up) {
    if (up && index[axis] + 1 < axes[axis].size()) ++index[axis];
    if (!up && index[axis] > 0) --index[axis];
  };
  switch (event->key()) {
    case Qt::Key_Left:
      move(1, true);
      break;
    case Qt::Key_Right:
      move(1, false);
      break;
    case Qt::Key_Up:
      move(2, true);
      break;
    case Qt::Key_Down:
      move(2, false);
      break;
    case Qt::Key_PageUp:
      move(0, true);
      break;
    case Qt::Key_PageDown:
      move(0, false);
      break;
    default:
      return QWidget::keyPressEvent(event);
  }
  choose(numberOf(index));
}

bool CubeView::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  if (const int cell = cellAt(help->pos()))
    QToolTip::showText(help->globalPos(), describe(cell), this);
  else
    QToolTip::hideText();
  return true;
}

}  // namespace btr::ui

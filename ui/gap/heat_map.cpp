#include "ui/gap/heat_map.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QScrollBar>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/gap/search/gap_report.h"
#include "ui/common/numbers/format.h"
#include "ui/gap/gap_plots.h"

namespace btr::ui {
namespace {

constexpr int margin = 8, scaleHeight = 26;
constexpr std::array scaleErrors{1.0, 2.0, 5.0, 10.0, 20.0, heatTop};

QColor colourOf(double error) {
  const HeatColour c = heatColour(error);
  QColor colour(c.red, c.green, c.blue);
  colour.setAlphaF(float(c.opacity));
  return colour;
}

}  // namespace

HeatMap::HeatMap(QWidget* parent) : QAbstractScrollArea(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setFrameShape(QFrame::NoFrame);
  setAccessibleName(tr("Standardised error by channel and time"));
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  viewport()->setMouseTracking(true);
  viewport()->setBackgroundRole(QPalette::Base);
}

void HeatMap::setReport(std::shared_ptr<const GapReport> report) {
  report_ = std::move(report);
  current_.reset();
  refill();
}

void HeatMap::setSimulated(Simulated which) {
  which_ = which;
  refill();
}

void HeatMap::refill() {
  rows_.clear();
  if (report_)
    for (std::size_t t = 0; t < report_->trials.size(); ++t)
      for (std::size_t s = 0; s < report_->trials[t].series.size(); ++s)
        rows_.push_back(heatRow(*report_, t, s, which_, bins));
  arrange();
  viewport()->update();
}

int HeatMap::rowHeight() const { return fontMetrics().height() + 6; }

int HeatMap::labelWidth() const {
  int wide = 60;
  for (const HeatRow& row : rows_) {
    const GapReport::Trial& trial = report_->trials[row.trial];
    const QString text = trialName(trial) + "  " + QString::fromStdString(trial.series[row.series].channel);
    wide = std::max(wide, fontMetrics().horizontalAdvance(text));
  }
  return std::min(wide + 2 * margin, viewport()->width() * 45 / 100);
}

void HeatMap::arrange() {
  const int all = int(rows_.size()) * rowHeight() + scaleHeight + rowHeight();
  verticalScrollBar()->setRange(0, std::max(0, all - viewport()->height()));
  verticalScrollBar()->setPageStep(viewport()->height());
  verticalScrollBar()->setSingleStep(rowHeight());
}

// The chosen cell stays in sight above the scale.
void HeatMap::reveal() {
  if (!current_) return;
  const QRect rect = rectOf(*current_);
  QScrollBar* bar = verticalScrollBar();
  if (rect.top() < 0) bar->setValue(bar->value() + rect.top() - 1);
  const int low = viewport()->height() - scaleHeight;
  if (rect.bottom() > low) bar->setValue(bar->value() + rect.bottom() - low + 2);
}

void HeatMap::resizeEvent(QResizeEvent*) {
  arrange();
  reveal();
}

QRect HeatMap::rectOf(Cell cell) const {
  const int left = labelWidth(), width = viewport()->width() - left - margin;
  const auto at = [&](std::size_t bin) { return left + int(std::lround(double(width) * double(bin) / double(bins))); };
  const int top = int(cell.row) * rowHeight() - verticalScrollBar()->value();
  return {at(cell.bin), top + 1, at(cell.bin + 1) - at(cell.bin), rowHeight() - 2};
}

std::optional<HeatMap::Cell> HeatMap::cellAt(const QPoint& place) const {
  const int row = (place.y() + verticalScrollBar()->value()) / rowHeight();
  const int left = labelWidth(), width = viewport()->width() - left - margin;
  if (place.y() < 0 || row < 0 || row >= rows() || width <= 0 || place.x() < left || place.x() >= left + width)
    return {};
  const auto bin = std::min(bins - 1, std::size_t(double(place.x() - left) * double(bins) / width));
  return Cell{std::size_t(row), bin};
}

QString HeatMap::describe(Cell cell) const {
  const HeatRow& row = rows_[cell.row];
  const GapReport::Trial& trial = report_->trials[row.trial];
  const double each = (row.to_s - row.from_s) / double(bins), from = row.from_s + each * double(cell.bin);
  const QString error = std::isfinite(row.error[cell.bin])
                            ? tr("%1 noise floors (RMS)").arg(shortNumber(row.error[cell.bin]))
                            : tr("not known");
  return tr("%1, %2\n%3 to %4 s: %5")
      .arg(trialName(trial), QString::fromStdString(trial.series[row.series].channel), QString::number(from, 'f', 2),
           QString::number(from + each, 'f', 2), error);
}

void HeatMap::choose(Cell cell) {
  if (cell.row >= rows_.size() || cell.bin >= bins) return;
  current_ = cell;
  reveal();
  setAccessibleDescription(describe(cell));
  viewport()->update();
  const HeatRow& row = rows_[cell.row];
  const double each = (row.to_s - row.from_s) / double(bins);
  emit chosen(row.trial, row.series, row.from_s + each * (double(cell.bin) + 0.5));
}

void HeatMap::chooseWorst() {
  std::optional<Cell> worst;
  double most = -1;
  for (std::size_t r = 0; r < rows_.size(); ++r)
    for (std::size_t b = 0; b < bins; ++b)
      if (std::isfinite(rows_[r].error[b]) && rows_[r].error[b] > most) {
        most = rows_[r].error[b];
        worst = Cell{r, b};
      }
  if (worst) choose(*worst);
}

void HeatMap::mousePressEvent(QMouseEvent* event) {
  const auto cell = event->button() == Qt::LeftButton ? cellAt(event->pos()) : std::nullopt;
  if (cell) choose(*cell);
}

void HeatMap::keyPressEvent(QKeyEvent* event) {
  Cell cell = current_.value_or(Cell{});
  switch (event->key()) {
    case Qt::Key_Left:
      cell.bin -= cell.bin > 0;
      break;
    case Qt::Key_Right:
      cell.bin = std::min(cell.bin + 1, bins - 1);
      break;
    case Qt::Key_Up:
      cell.row -= cell.row > 0;
      break;
    case Qt::Key_Down:
      cell.row = rows_.empty() ? 0 : std::min(cell.row + 1, rows_.size() - 1);
      break;
    default:
      return QAbstractScrollArea::keyPressEvent(event);
  }
  choose(cell);
}

bool HeatMap::viewportEvent(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QAbstractScrollArea::viewportEvent(event);
  const auto* help = static_cast<QHelpEvent*>(event);
  if (const auto cell = cellAt(help->pos()))
    QToolTip::showText(help->globalPos(), describe(*cell), viewport(), rectOf(*cell));
  else
    QToolTip::hideText();
  return true;
}

// Below the cells, further to the left where these are narrow.
std::vector<QRect> HeatMap::scalePlaces() const {
  const int least = 29 + fontMetrics().horizontalAdvance("≥ 50"), count = int(scaleErrors.size());
  const int step = std::clamp(viewport()->width() / count, least, least + 7 + margin);
  const int left = std::max(0, std::min(labelWidth(), viewport()->width() - count * step));
  std::vector<QRect> places;
  for (int i = 0; i < count; ++i)
    places.emplace_back(left + i * step, viewport()->height() - scaleHeight, least, scaleHeight);
  return places;
}

// How to read the colours, below the rows.
void HeatMap::paintScale(QPainter& painter) const {
  const int top = viewport()->height() - scaleHeight, text = fontMetrics().height();
  painter.fillRect(0, top, viewport()->width(), scaleHeight, palette().base());
  const std::vector<QRect> places = scalePlaces();
  painter.setPen(palette().color(QPalette::Text));
  painter.drawText(QRect(0, top, places.front().left() - margin, scaleHeight), Qt::AlignRight | Qt::AlignVCenter,
                   tr("error (noise floors)"));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double error = scaleErrors[i];
    const QRect box(places[i].left(), top + (scaleHeight - text) / 2, 24, text);
    painter.fillRect(box, colourOf(error));
    painter.setPen(palette().color(QPalette::Mid));
    painter.drawRect(box);
    painter.setPen(palette().color(QPalette::Text));
    const QString label = (error == 1 ? "≤ " : error == heatTop ? "≥ " : "") + QString::number(error);
    painter.drawText(places[i].adjusted(29, 0, margin, 0), Qt::AlignLeft | Qt::AlignVCenter, label);
  }
}

void HeatMap::paintEvent(QPaintEvent*) {
  QPainter painter(viewport());
  painter.fillRect(viewport()->rect(), palette().base());
  if (rows_.empty()) {
    painter.setPen(palette().color(QPalette::PlaceholderText));
    painter.drawText(viewport()->rect(), Qt::AlignCenter, tr("The map shows where simulated and recorded differ"));
    return;
  }
  const int labels = labelWidth();
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const QRect first = rectOf({r, 0});
    if (first.bottom() < 0 || first.top() > viewport()->height() - scaleHeight) continue;
    const GapReport::Trial& trial = report_->trials[rows_[r].trial];
    const QString channel = QString::fromStdString(trial.series[rows_[r].series].channel);
    // A trial's name stands once, before its first channel.
    const QString name = rows_[r].series == 0 ? trialName(trial) : QString();
    painter.setPen(palette().color(QPalette::Text));
    const QRect place(margin, first.top(), labels - 2 * margin, first.height());
    painter.drawText(place, Qt::AlignRight | Qt::AlignVCenter,
                     fontMetrics().elidedText(channel, Qt::ElideLeft, place.width()));
    const int left = place.width() - fontMetrics().horizontalAdvance(channel) - margin;
    painter.setPen(palette().color(QPalette::PlaceholderText));
    if (left > 30)
      painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, fontMetrics().elidedText(name, Qt::ElideMiddle, left));
    for (std::size_t b = 0; b < bins; ++b)
      if (std::isfinite(rows_[r].error[b])) painter.fillRect(rectOf({r, b}), colourOf(rows_[r].error[b]));
    painter.setPen(palette().color(QPalette::Mid));
    painter.drawRect(QRect(first.topLeft(), rectOf({r, bins - 1}).bottomRight()));
  }
  if (current_) {
    painter.setPen(QPen(palette().color(hasFocus() ? QPalette::Highlight : QPalette::Text), 2));
    painter.drawRect(rectOf(*current_).adjusted(-1, -1, 1, 1));
  }
  paintScale(painter);
}

}  // namespace btr::ui

#include "ui/gap/report_view.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QSplitter>
#include <QTabWidget>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <algorithm>

#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_lead.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/figures.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/gap/effects_table.h"
#include "ui/gap/gap_plots.h"
#include "ui/gap/heat_map.h"

namespace btr::ui {
namespace {

QLabel* paragraph(QWidget* parent) {
  auto* label = new QLabel(parent);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  label->setTextFormat(Qt::PlainText);  // names come from files
  label->setContentsMargins(8, 6, 8, 6);
  return label;
}

/// A widget with its parts one below the other; the last takes the room.
QWidget* column(QWidget* parent, std::initializer_list<QWidget*> parts) {
  auto* all = new QWidget(parent);
  auto* layout = new QVBoxLayout(all);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  for (QWidget* part : parts) layout->addWidget(part, part == *(parts.end() - 1) ? 1 : 0);
  return all;
}

}  // namespace

ReportView::ReportView(QWidget* parent) : QWidget(parent) {
  headline_ = paragraph(this);
  headline_->setObjectName("headline");
  sentence_ = paragraph(this);
  sentence_->setObjectName("sentence");
  QFont font = headline_->font();
  font.setBold(true);
  font.setPointSizeF(font.pointSizeF() * 1.25);
  headline_->setFont(font);
  headline_->setContentsMargins(8, 6, 8, 0);

  tabs_ = new QTabWidget(this);
  tabs_->setDocumentMode(true);
  ladder_ = new PlotWidget(this);
  effects_ = new EffectsTable(this);
  calibrated_ = new CalibratedTable(this);
  errors_ = new ErrorsTable(this);
  remainder_ = new PlotWidget(this);
  remainderText_ = paragraph(this);
  notes_ = paragraph(this);
  notes_->setAlignment(Qt::AlignTop);
  steps_ = new StepsTable(this);
  auto* stepByStep = new QSplitter(Qt::Vertical, this);
  stepByStep->addWidget(ladder_);
  stepByStep->addWidget(steps_);
  stepByStep->setStretchFactor(0, 3);
  stepByStep->setStretchFactor(1, 1);
  tabs_->addTab(makeFindings(), tr("&Findings"));
  tabs_->addTab(makeWhere(), tr("&Where it differs"));
  tabs_->addTab(stepByStep, tr("&Step by step"));
  tabs_->addTab(errors_, tr("Err&ors"));
  tabs_->addTab(makeRegimes(), tr("&Regimes"));
  tabs_->addTab(effects_, tr("&Effects tried"));
  tabs_->addTab(calibrated_, tr("&Calibrated"));
  tabs_->addTab(column(this, {remainderText_, remainder_}), tr("Re&mainder"));
  tabs_->addTab(makeNext(), tr("&Next recording"));
  tabs_->addTab(notes_, tr("N&otes"));

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(headline_);
  layout->addWidget(sentence_);
  layout->addWidget(tabs_, 1);
  setReport(nullptr);
}

QWidget* ReportView::makeFindings() {
  findings_ = new QTextBrowser(this);
  findings_->setObjectName("findings");
  findings_->setAccessibleName(tr("What was found, and what to do next"));
  findings_->setFrameShape(QFrame::NoFrame);
  picture_ = new PlotWidget(this);
  picture_->setObjectName("picture");
  auto* splitter = new QSplitter(Qt::Vertical, this);
  splitter->addWidget(findings_);
  splitter->addWidget(picture_);
  splitter->setStretchFactor(0, 3);
  splitter->setStretchFactor(1, 2);
  splitter->setChildrenCollapsible(false);
  return splitter;
}

void ReportView::showFindings(const ReportLead& lead) {
  if (!report_) {
    findings_->clear();
    picture_->setData(overlayPlot(GapReport{}, 0, 0));
    return;
  }
  findings_->setHtml(word(leadHtml(*report_, lead)) + "<p>" + word(report_->sentence).toHtmlEscaped() + "</p>");
  const auto [trial, series] = lead.picture.value_or(std::pair<std::size_t, std::size_t>(0, 0));
  // What lies between as given and in the end is under "Where it differs".
  picture_->setData(overlayPlot(*report_, trial, series, {}, false));
}

QWidget* ReportView::makeWhere() {
  which_ = new QComboBox(this);
  which_->setObjectName("which");
  which_->addItems({tr("as given"), tr("calibrated"), tr("with effects")});
  which_->setToolTip(tr("Which simulator the map compares with the recordings"));
  channel_ = new QComboBox(this);
  channel_->setObjectName("channel");
  channel_->setToolTip(tr("Trial and channel of the curves below; held-out trials were never used in a fit"));
  channel_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  channel_->setMinimumContentsLength(34);
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(8, 4, 8, 4);
  row->addWidget(new QLabel(tr("Error of the simulator")));
  row->addWidget(which_);
  row->addSpacing(16);
  row->addWidget(new QLabel(tr("Curves of")));
  row->addWidget(channel_, 1);

  map_ = new HeatMap(this);
  overlay_ = new PlotWidget(this);
  overlay_->setObjectName("overlay");
  error_ = new PlotWidget(this);
  error_->setObjectName("error");
  auto* splitter = new QSplitter(Qt::Vertical, this);
  splitter->addWidget(map_);
  splitter->addWidget(overlay_);
  splitter->addWidget(error_);
  splitter->setStretchFactor(0, 2);
  splitter->setStretchFactor(1, 2);
  splitter->setStretchFactor(2, 1);
  splitter->setSizes({260, 300, 220});
  splitter->setChildrenCollapsible(false);

  connect(overlay_, &PlotWidget::rangeChanged, this, [this] { follow(*error_, *overlay_); });
  connect(error_, &PlotWidget::rangeChanged, this, [this] { follow(*overlay_, *error_); });
  connect(which_, &QComboBox::currentIndexChanged, this,
          [this](int index) { map_->setSimulated(static_cast<Simulated>(index)); });
  connect(channel_, &QComboBox::activated, this, [this](int index) {
    if (index >= 0 && index < map_->rows())
      showChannel(map_->row(std::size_t(index)).trial, map_->row(std::size_t(index)).series, cursor_);
  });
  connect(map_, &HeatMap::chosen, this, [this](std::size_t trial, std::size_t series, double time_s) {
    showChannel(trial, series, time_s);
    emit timeChosen(trial, time_s);
  });
  return column(this, {bar, splitter});
}

QWidget* ReportView::makeRegimes() {
  located_ = new QComboBox(this);
  located_->setObjectName("located");
  located_->setToolTip(tr("Channel whose excess error is divided, largest share first"));
  regimes_ = new PlotWidget(this);
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(8, 4, 8, 4);
  row->addWidget(new QLabel(tr("Channel")));
  row->addWidget(located_, 1);
  connect(located_, &QComboBox::currentIndexChanged, this, [this](int index) {
    if (report_ && index >= 0) regimes_->setData(regimePlot(*report_, std::size_t(index)));
  });
  return column(this, {bar, regimes_});
}

QWidget* ReportView::makeNext() {
  nextText_ = paragraph(this);
  next_ = new PlotWidget(this);
  saveNext_ = new QPushButton(themeIcon("document-save-as"), tr("Save the commands as…"), this);
  saveNext_->setToolTip(tr("CSV with time_s and the commands in their units"));
  connect(saveNext_, &QPushButton::clicked, this, &ReportView::saveNextRequested);
  auto* bar = new QWidget(this);
  auto* row = new QHBoxLayout(bar);
  row->setContentsMargins(0, 0, 8, 0);
  row->addWidget(nextText_, 1);
  row->addWidget(saveNext_, 0, Qt::AlignTop);
  return column(this, {bar, next_});
}

// Both plots of a recording show the same time; their values have axes of their own.
void ReportView::follow(PlotWidget& other, const PlotWidget& moved) {
  const QRectF now = other.visibleRange(), wanted = moved.visibleRange();
  if (now.left() == wanted.left() && now.right() == wanted.right()) return;
  const QSignalBlocker quiet(&other);
  if (!moved.isZoomed()) return other.resetZoom();
  other.zoomTo(QRectF(wanted.left(), now.top(), wanted.width(), now.height()));
}

void ReportView::setReport(std::shared_ptr<const GapReport> report) {
  report_ = std::move(report);
  cursor_.reset();
  tabs_->setCurrentIndex(0);  // what was found
  const GapReport empty;
  const GapReport& shown = report_ ? *report_ : empty;
  map_->setReport(report_);
  fillChoices();
  ladder_->setData(ladderPlot(shown));
  steps_->setReport(shown);
  regimes_->setData(regimePlot(shown, 0));
  effects_->setReport(shown);
  calibrated_->setReport(shown);
  errors_->setReport(shown);
  remainder_->setData(remainderPlot(shown));
  next_->setData(nextRecordingPlot(shown));
  saveNext_->setEnabled(!shown.next.columns.empty());
  nextText_->setText(shown.next.why.empty() ? tr("Nothing that a further recording would settle.")
                                            : tr("%1: expected difference %2 noise floors (RMS).")
                                                  .arg(word(shown.next.why), word(brief(shown.next.separation))));
  remainderText_->setText(
      shown.remainder.on.empty()
          ? tr("The accepted effects explain %1 of the excess error.")
                .arg(word(percent(shown.remainder.explainedShare)))
          : tr("The accepted effects explain %1 of the excess error. A force over %2 at %3 takes away %4 of the rest "
               "(p = %5); no name fits it.")
                .arg(word(percent(shown.remainder.explainedShare)), word(shown.remainder.on), word(shown.remainder.at),
                     word(percent(shown.remainder.shareOfRest)), word(brief(shown.remainder.pValue))));
  QStringList notes;
  for (const std::string& note : shown.notes) notes << "• " + word(note);
  for (const std::string& pair : shown.strongCorrelations) notes << tr("• hardly separated: %1").arg(word(pair));
  for (const GapReport::Trial& trial : shown.trials)
    notes << tr("• %1: SHA-256 %2").arg(trialName(trial), word(trial.sha256));
  if (report_)
    notes
        << tr("• UCHILSIM %1, seed %2, %3 s").arg(word(shown.version)).arg(shown.seed).arg(word(brief(shown.seconds)));
  notes_->setText(notes.join('\n'));
  showVerdict();
  if (report_) {
    showChannel(0, 0, {});
    map_->chooseWorst();
  } else {
    overlay_->setData(overlayPlot(shown, 0, 0));
    error_->setData(errorPlot(shown, 0, 0));
  }
}

void ReportView::showVerdict() {
  const Tones tones = tonesOf(palette());
  QColor colour = tones.muted;
  if (report_) {
    using Verdict = GapReport::Verdict;
    const Verdict v = report_->verdict;
    colour = v == Verdict::noMismatch || v == Verdict::parametersSuffice     ? tones.good
             : v == Verdict::missingPhysics || v == Verdict::partlyExplained ? tones.accent
                                                                             : tones.warning;
    if (!unseenWarning(*report_).empty()) colour = tones.bad;
  }
  QPalette colours = headline_->palette();
  colours.setColor(QPalette::WindowText, colour);
  headline_->setPalette(colours);
  const ReportLead lead = report_ ? leadOf(*report_) : ReportLead{};
  headline_->setText(report_ ? word(lead.headline) : tr("No report yet"));
  sentence_->setText(tr("Start an analysis, or open the folder of a report that is there already."));
  sentence_->setVisible(!report_);
  showFindings(lead);
}

void ReportView::fillChoices() {
  const QSignalBlocker quiet(channel_), silent(located_);
  channel_->clear();
  located_->clear();
  if (!report_) return;
  for (int i = 0; i < map_->rows(); ++i) {
    const GapReport::Trial& trial = report_->trials[map_->row(std::size_t(i)).trial];
    channel_->addItem(trialName(trial) + " · " + word(trial.series[map_->row(std::size_t(i)).series].channel));
  }
  for (const GapReport::Located& l : report_->located)
    located_->addItem(tr("%1 (%2 of the excess error)").arg(word(l.channel), word(percent(l.shareOfExcess))));
}

// Around the chosen time; a double click in the plot shows everything again.
void ReportView::showChannel(std::size_t trial, std::size_t series, std::optional<double> time_s) {
  cursor_ = time_s;
  if (!report_ || trial >= report_->trials.size()) return;
  for (int i = 0; i < map_->rows(); ++i)
    if (map_->row(std::size_t(i)).trial == trial && map_->row(std::size_t(i)).series == series)
      channel_->setCurrentIndex(i);
  overlay_->setData(overlayPlot(*report_, trial, series, time_s));
  error_->setData(errorPlot(*report_, trial, series, time_s));
  const std::vector<double>& time = report_->trials[trial].time_s;
  if (!time_s || time.size() < 2) return;
  const double half = std::max((time.back() - time.front()) / 12, 0.25);
  for (PlotWidget* plot : {overlay_, error_}) {
    plot->resetZoom();
    const QRectF all = plot->visibleRange();
    const double from = std::max(all.left(), *time_s - half), to = std::min(all.right(), *time_s + half);
    if (to > from) plot->zoomTo(QRectF(from, all.top(), to - from, all.height()));
  }
}

void ReportView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && headline_) {
    // Colours with a meaning follow light and dark; the labels' own change comes back here once, with nothing new.
    const QColor before = headline_->palette().color(QPalette::WindowText);
    showVerdict();
    if (report_ && before != headline_->palette().color(QPalette::WindowText)) {
      effects_->setReport(*report_);
      errors_->setReport(*report_);
    }
  }
}

}  // namespace btr::ui

#include "ui/window/window_messages.h"

#include <QFileInfo>
#include <QLabel>
#include <QMainWindow>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>

#include "ui/common/look/message_banner.h"
#include "ui/common/look/plain_tip.h"
#include "ui/controllers/workbench.h"

namespace btr::ui {
namespace {

// As high as its message needs at the window's width: a tool bar would take the height that a narrow text would need.
class MessageArea final : public QWidget {
 public:
  using QWidget::QWidget;
  QSize sizeHint() const override {
    const int wide = window()->width();
    return {QWidget::sizeHint().width(),
            layout()->hasHeightForWidth() ? layout()->heightForWidth(wide) : layout()->sizeHint().height()};
  }
};

}  // namespace

WindowMessages::WindowMessages(QMainWindow& window, Workbench& bench)
    : QObject(&window),
      window_(window),
      bench_(bench),
      banner_(new MessageBanner(&window)),
      bar_(new QToolBar(tr("Messages"), &window)),
      database_(new QLabel(&window)),
      active_(new QLabel(&window)),
      reading_(new QLabel(&window)) {
  database_->setTextFormat(Qt::PlainText);
  makeBar();
  makeStatusLine();
  showDatabase();
  connect(&bench_, &Workbench::databaseOpened, this, [this] {
    banner_->clear();
    showDatabase();
    QStringList notes;
    if (bench_.isReadOnly())
      notes << tr("%1 may only be read: it can be looked at, and nothing can be started or entered.")
                   .arg(QFileInfo(bench_.path()).fileName());
    if (const QString where = bench_.networkWarning(); !where.isEmpty()) notes << where;
    if (!notes.isEmpty()) bench_.note(notes.join('\n'));
  });
}

// A tool bar of its own that is there only while there is a message.
void WindowMessages::makeBar() {
  bar_->setObjectName("toolbar.messages");
  bar_->setMovable(false);
  bar_->toggleViewAction()->setVisible(false);
  auto* stack = new MessageArea(bar_);
  auto* column = new QVBoxLayout(stack);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(banner_);
  stack->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
  bar_->addWidget(stack);
  window_.addToolBar(Qt::TopToolBarArea, bar_);
  const auto showIfAny = [this] {
    const bool any = !banner_->text().isEmpty();
    if (any && bar_->isHidden()) emit aboutToTakeRoom();
    bar_->setVisible(any);
  };
  showIfAny();
  connect(banner_, &MessageBanner::shown, bar_, showIfAny);
  connect(banner_, &MessageBanner::cleared, bar_, showIfAny);
  connect(&bench_, &Workbench::reported, banner_,
          [this](const QString& error) { banner_->showMessage(MessageBanner::Kind::error, error); });
  connect(&bench_, &Workbench::noted, banner_,
          [this](const QString& text) { banner_->showMessage(MessageBanner::Kind::information, text); });
  connect(&bench_, &Workbench::mended, banner_, [this](const QString& error) {
    if (banner_->text() == error) banner_->clear();
  });
  connect(&bench_, &Workbench::messagesOver, banner_, &MessageBanner::clear);
}

void WindowMessages::makeStatusLine() {
  database_->setObjectName("database");
  reading_->setObjectName("reading");
  for (QLabel* label : {reading_, active_, database_}) {
    label->setTextFormat(Qt::PlainText);
    label->setContentsMargins(6, 0, 6, 0);
    window_.statusBar()->addPermanentWidget(label);
  }
  connect(&bench_, &Workbench::informed, this,
          [this](const QString& text) { window_.statusBar()->showMessage(text, 8000); });
  connect(&bench_.reader(), &DatabaseReader::waiting, reading_, [this](const QStringList& what) {
    reading_->setText(what.isEmpty() ? QString() : tr("Reading %1 …").arg(what.join(tr(", "))));
  });
  connect(&bench_.watcher(), &DatabaseWatcher::activeChanged, this, [this](const std::set<Id>& active) {
    active_->setText(active.empty()       ? QString()
                     : active.size() == 1 ? tr("1 run is working")
                                          : tr("%1 runs are working").arg(active.size()));
  });
}

void WindowMessages::showDatabase() {
  const QString name = QFileInfo(bench_.path()).fileName();
  const QString shown = bench_.isReadOnly() ? tr("%1 (read only)").arg(name) : name;
  window_.setWindowTitle(name.isEmpty() ? QStringLiteral("UCHILSIM") : shown + QStringLiteral(" — UCHILSIM"));
  window_.setWindowFilePath(QString());
  database_->setText(name.isEmpty() ? tr("No database") : shown);
  database_->setToolTip(plainTip(bench_.path()));
}

}  // namespace btr::ui

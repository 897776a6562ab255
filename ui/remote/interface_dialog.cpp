#include "ui/remote/interface_dialog.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "ui/remote/interface_server.h"

namespace btr::ui {

InterfaceDialog::InterfaceDialog(InterfaceServer& server, std::function<QString()> database, QWidget* parent)
    : QDialog(parent), server_(server), database_(std::move(database)) {
  setWindowTitle(tr("Open interface"));
  setObjectName("interface");
  port_ = new QSpinBox;
  port_->setObjectName("interface.port");
  port_->setRange(0, 65535);
  port_->setValue(InterfaceOptions().port);
  port_->setToolTip(tr("Of this machine alone; 0: any that is free"));
  folder_ = new QLineEdit;
  folder_->setObjectName("interface.folder");
  folder_->setPlaceholderText(tr("the program's own, which are only read"));
  folder_->setToolTip(tr("Clients may name files of this folder only; what they do is logged in it"));
  auto* choose = new QPushButton(tr("Choose…"));
  connect(choose, &QPushButton::clicked, this, [this] {
    if (const QString chosen =
            QFileDialog::getExistingDirectory(this, tr("Folder of the open interface"), folder_->text());
        !chosen.isEmpty())
      folder_->setText(chosen);
  });
  runs_ = new QCheckBox(tr("Runs of the open &database"));
  runs_->setObjectName("interface.runs");
  runs_->setChecked(true);
  state_ = new QLabel;
  state_->setObjectName("interface.state");
  state_->setWordWrap(true);
  state_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  state_->setMinimumWidth(fontMetrics().averageCharWidth() * 60);

  auto* files = new QHBoxLayout;
  files->addWidget(folder_);
  files->addWidget(choose);
  auto* form = new QFormLayout;
  form->addRow(tr("&Port"), port_);
  auto* folderLabel = new QLabel(tr("&Folder"));
  folderLabel->setBuddy(folder_);
  form->addRow(folderLabel, files);
  form->addRow(QString(), runs_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  turn_ = buttons->addButton(QString(), QDialogButtonBox::ActionRole);
  turn_->setObjectName("interface.turn");
  connect(turn_, &QPushButton::clicked, this, &InterfaceDialog::turn);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
  auto* column = new QVBoxLayout(this);
  auto* what = new QLabel(tr(
      "Other people's programs watch worlds, drive them and learn in them. It is on until you switch it off or close "
      "the window."));
  what->setWordWrap(true);
  column->addWidget(what);
  column->addLayout(form);
  column->addWidget(state_);
  column->addWidget(buttons);
  connect(&server_, &InterfaceServer::changed, this, [this] { tell(server_.state()); });
  tell(server_.state());
}

void InterfaceDialog::turn() {
  if (server_.isOn()) return server_.stop();
  server_.start({port_->value(), folder_->text(), runs_->isChecked() ? database_() : QString()});
}

void InterfaceDialog::tell(const QString& state) {
  const bool on = server_.isOn();
  state_->setText(state);
  turn_->setText(on ? tr("Switch &off") : tr("Switch &on"));
  for (QWidget* each : {static_cast<QWidget*>(port_), static_cast<QWidget*>(folder_), static_cast<QWidget*>(runs_)})
    each->setEnabled(!on);
}

}  // namespace btr::ui

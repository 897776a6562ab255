#include "ui/common/plugins_dialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <QVBoxLayout>

#include "core/plugin/plugin_host.h"
#include "ui/common/look/fit_screen.h"

namespace btr::ui {
namespace {

QTableWidget* tableOf(const QStringList& header, const std::vector<QStringList>& rows, QWidget* parent) {
  auto* table = new QTableWidget(int(rows.size()), int(header.size()), parent);
  table->setHorizontalHeaderLabels(header);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setTabKeyNavigation(false);
  table->verticalHeader()->hide();
  for (int row = 0; row < int(rows.size()); ++row)
    for (int column = 0; column < int(header.size()); ++column) {
      const QString& text = rows[std::size_t(row)][column];
      auto* item = new QTableWidgetItem(text.isEmpty() ? QStringLiteral("–") : text);
      item->setToolTip(text);
      table->setItem(row, column, item);
    }
  table->resizeColumnsToContents();
  table->horizontalHeader()->setStretchLastSection(true);
  return table;
}

}  // namespace

PluginsDialog::PluginsDialog(const PluginHost& host, QWidget* parent) : QDialog(parent) {
  setWindowTitle(tr("Plugins"));
  const auto text = [](const std::string& s) { return QString::fromStdString(s); };
  auto* column = new QVBoxLayout(this);

  std::vector<QStringList> rows;
  for (const PluginInfo& p : host.plugins())
    rows.push_back({text(p.kind), text(p.name), text(p.version), text(p.author), text(p.licence), text(p.path)});
  auto* plugins = tableOf({tr("Kind"), tr("Name"), tr("Version"), tr("Author"), tr("Licence"), tr("Path")}, rows, this);
  plugins->setObjectName("plugins");
  plugins->setAccessibleName(tr("Plugins that were loaded"));
  plugins->setSortingEnabled(true);
  plugins->sortByColumn(0, Qt::AscendingOrder);
  column->addWidget(plugins, 3);

  const std::vector<PluginFailure> failures = host.failures();
  auto* caption = new QLabel(failures.empty() ? tr("All that was found was loaded.") : tr("Not loaded:"), this);
  caption->setObjectName("failuresCaption");
  column->addWidget(caption);
  if (!failures.empty()) {
    std::vector<QStringList> reasons;
    for (const PluginFailure& f : failures) reasons.push_back({text(f.path), text(f.why)});
    auto* table = tableOf({tr("Path"), tr("Why")}, reasons, this);
    table->setObjectName("failures");
    table->setAccessibleName(tr("What could not be loaded, and why"));
    table->setWordWrap(true);
    column->addWidget(table, 1);
  }

  QString folders;
  for (const std::string& folder : PluginHost::searchPath()) folders += (folders.isEmpty() ? "" : "\n") + text(folder);
  auto* searched = new QLabel(tr("Searched folders:\n%1").arg(folders), this);
  searched->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(searched);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  resizeWithinScreen(*this, {900, 560});
}

}  // namespace btr::ui

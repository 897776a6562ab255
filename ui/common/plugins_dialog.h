#pragma once
#include <QDialog>

namespace btr {
class PluginHost;
}

namespace btr::ui {

/// All plugins that were loaded: kind, name, version, author, licence and path; below them what could not be loaded,
/// and why.
class PluginsDialog : public QDialog {
  Q_OBJECT
 public:
  explicit PluginsDialog(const PluginHost& host, QWidget* parent = nullptr);
};

}  // namespace btr::ui

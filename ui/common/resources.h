#pragma once
#include <QString>
#include <QStringList>

namespace btr::ui {

/// The folder with scenes and example experiments: $UCHILSIM_RESOURCES, else "resources" beside or above the
/// executable. Empty if there is none.
QString resourceDirectory();
/// Full paths of the example experiments, sorted by name.
QStringList exampleExperiments();

}  // namespace btr::ui

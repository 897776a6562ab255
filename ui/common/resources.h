#pragma once
#include <QString>
#include <QStringList>

namespace btr::ui {

/// The folder with scenes and example experiments: $UCHILSIM_RESOURCES, else "resources" beside or above the
/// executable. Empty if there is none.
QString resourceDirectory();
/// Full paths of the example experiments, sorted by name.
QStringList exampleExperiments();
/// The same of grids.
QStringList exampleGrids();

}  // namespace btr::ui

#pragma once
#include <QString>
#include <QStringList>

namespace btr::ui {

/// The folder with scenes and example experiments: $UCHILSIM_RESOURCES, else "resources" beside or above the
/// executable. Empty if there is none.
QString resourceDirectory();
/// Full paths of the example experiments, sorted by name.
QStringList exampleExperiments();
/// The name that an example gives itself; its file's name where it gives none.
QString exampleName(const QString& file);
/// The database that comes with the program; empty if it is not there.
QString exampleDatabase();
/// The same of grids.
QStringList exampleGrids();

}  // namespace btr::ui

#pragma once
#include <QString>

#include "core/run/reality/plausibility.h"
#include "core/run/reality/resting_simulator.h"

class QWidget;

namespace btr::ui {

enum class ImportAnswer { nothingAsked, confirmed, cancelled };

/// Asks about the values of a table that are far from what is expected, with their lines. Throws InputError for a table
/// that cannot be read.
ImportAnswer askAboutImport(QWidget* parent, const QString& file, const KnownFitness& known);

/// Says that a simulator version was adapted to a value that has just been made void. True: go back to the version
/// before it, so that the next adaptation begins there.
bool askToGoBack(QWidget* parent, const RestingSimulator& resting);

}  // namespace btr::ui

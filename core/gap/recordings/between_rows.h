#pragma once
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/sim/scene.h"

namespace btr {

// What a drive is told between two rows. A table that a controller writes at its own period has all of it: each command
// holds until the next row. A logger of its own, slower than the controller, writes down every so many of them: a
// command that moves on smoothly did so between the rows, too, and holding it would make it half a row late.

/// The value of an input from `row` on to the next one; NaN for an empty cell. An input that goes on from row to row is
/// so far ahead as the recording says (Recording::betweenRows), one that steps or stands holds.
double inputFrom(const Recording& recording, const Binding::Input& input, std::size_t row);

/// Whether an input of this recording moves smoothly from row to row and nothing says that it holds there: neither the
/// mapping, nor a scene whose control period is that of the rows.
bool mayGoOnBetweenRows(const Scene& scene, const Recording& recording, const Binding& binding);

}  // namespace btr

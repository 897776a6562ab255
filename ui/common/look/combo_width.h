#pragma once
#include <QComboBox>

namespace btr::ui {

/// A combo box in a narrow form: it takes the room that there is and leaves out what does not fit, instead of asking
/// for the width of its longest entry, which would push what stands beside it out of sight.
inline void letShrink(QComboBox& box) {
  constexpr int leastLetters = 10;
  box.setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box.setMinimumContentsLength(leastLetters);
}

}  // namespace btr::ui

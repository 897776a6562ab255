#pragma once
#include <QString>
#include <QTextDocument>

namespace btr::ui {

/// A tool tip that shows a person's words as they are: Qt takes what looks like HTML for HTML, and shows no tag.
inline QString plainTip(const QString& text) {
  return Qt::mightBeRichText(text) ? Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal) : text;
}

}  // namespace btr::ui

#pragma once
#include <QString>

class QWidget;

namespace btr::ui {

/// The manual as the build made it: a folder of HTML pages.
class Manual {
 public:
  explicit Manual(const QString& folder = standardFolder()) : folder_(folder) {}
  /// share/uchilsim/manual beside the folder of the executable; it need not exist.
  static QString standardFolder();
  /// The page about the dock that holds the widget, "charts.html" or "experiments.html#the-whole-kick";
  /// "index.html" if there is none.
  static QString pageFor(const QWidget* widget);
  /// Shows the page in the user's browser. Returns what went wrong, empty if nothing did.
  QString open(const QString& page) const;

 private:
  QString folder_;
};

}  // namespace btr::ui

#pragma once
#include <QWidget>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "core/spec/parameter.h"

class QLabel;
class QPushButton;

namespace btr::ui {
class LiveWorld;

/// Two sets of a robot's controller parameters, A and B, that are switched while it runs.
class ParameterSets : public QWidget {
  Q_OBJECT
 public:
  explicit ParameterSets(LiveWorld& world, QWidget* parent = nullptr);

  void showRobot(const std::string& robot);
  /// The shown robot's present parameters become set 0 (A) or 1 (B).
  void store(int set);
  /// The robot plays with that set; nothing if it was not stored.
  void use(int set);
  /// The other one of the two.
  void change();
  /// "format": "uchilsim-parameters-1". Throw InputError.
  void save(int set, const QString& path) const;
  void load(int set, const QString& path);

 signals:
  void used(const QString& mark);  ///< "dog: A"
  void problem(const QString& why);

 private:
  struct Sets {
    std::string plugin;
    std::array<std::optional<Values>, 2> values;
    int inUse = -1;  ///< −1: neither
  };
  Sets& mine();
  void showState();
  void saveWithDialog(int set);
  void loadWithDialog(int set);

  LiveWorld& world_;
  std::string robot_;
  std::map<std::string, Sets> sets_;  ///< by robot
  std::array<QPushButton*, 2> use_{};
};

}  // namespace btr::ui

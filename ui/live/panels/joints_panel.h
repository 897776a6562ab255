#pragma once
#include <QWidget>
#include <string>
#include <vector>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QScrollArea;
class QSlider;

namespace btr::ui {
class LiveWorld;

/// The joints of the selected robot: where each is, and a hand that holds it at an angle whatever its controller says.
class JointsPanel : public QWidget {
  Q_OBJECT
 public:
  explicit JointsPanel(LiveWorld& world, QWidget* parent = nullptr);
  /// Of the robot that is selected; anew only for another one.
  void showRobot();
  /// Where the joints are now.
  void showRow();
  void showJoint(const std::string& joint);

 private:
  struct Line {
    std::string joint;
    bool slides = false;
    QCheckBox* hold = nullptr;
    QSlider* slider = nullptr;
    QDoubleSpinBox* number = nullptr;
    QLabel* reached = nullptr;
    double perUnit() const;  ///< rad or m in one of what people read, ° or mm
  };
  void add(QWidget* content, const std::string& joint, bool slides, double lower, double upper);
  void moveTo(std::size_t line, double shown);
  void hold(std::size_t line, bool on);

  LiveWorld& world_;
  std::string robot_;
  std::vector<Line> lines_;
  QLabel* none_;
  QScrollArea* area_;
};

}  // namespace btr::ui

#pragma once
#include <Eigen/Core>
#include <QColor>
#include <string>
#include <vector>

#include "core/live/game.h"
#include "core/model/robot_model.h"

namespace btr::ui {

/// Where a robot's lamp shines: a spot on a link.
struct LampSpot {
  std::string lamp;  ///< as in Orders::lamps
  std::string link;
  Eigen::Vector3d place_m, outward;  ///< in the link's frame; outward: unit
  QColor colour, colourB;            ///< colourB: in mode B
};

/// Of the ERS-7 and the ERS-210, by the model's name; of others none. The face after the picture in Sony's Model
/// Information, on the face of our model; other places and the colours of the back are ours.
const std::vector<LampSpot>& lampSpots(const std::string& model);

/// The colour in which it shines now, with its brightness as alpha; not valid: it is dark.
QColor shining(const LampSpot& spot, const Orders& orders);

}  // namespace btr::ui

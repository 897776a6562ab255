// Corners of a chessboard in a photograph.
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/camera/twin.h"

namespace btr {
namespace {

/// Half the side of the window in which a corner is refined: it must not reach the next corner.
int windowFor(const std::vector<cv::Point2f>& corners, int columns) {
  double least = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (i % static_cast<std::size_t>(columns) != 0) least = std::min(least, cv::norm(corners[i] - corners[i - 1]));
  for (std::size_t i = static_cast<std::size_t>(columns); i < corners.size(); ++i)
    least = std::min(least, cv::norm(corners[i] - corners[i - static_cast<std::size_t>(columns)]));
  return std::clamp(static_cast<int>(0.4 * least), 2, 11);
}

}  // namespace

std::optional<PointView> boardView(const RgbPicture& photo, const BoardPattern& board, const std::string& name) {
  const cv::Mat rgb(photo.height, photo.width, CV_8UC3, const_cast<std::uint8_t*>(photo.rgb.data()));
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(grey, {board.columns, board.rows}, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE))
    return {};
  const int window = windowFor(corners, board.columns);
  cv::cornerSubPix(grey, corners, {window, window}, {-1, -1},
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4));
  PointView view;
  view.name = name;
  for (int i = 0; i < board.columns * board.rows; ++i) {
    const cv::Point2f& corner = corners[static_cast<std::size_t>(i)];
    view.points_m.push_back({board.square_m * (i % board.columns), board.square_m * (i / board.columns), 0});
    view.seen_px.push_back({static_cast<double>(corner.x), static_cast<double>(corner.y)});
  }
  return view;
}

}  // namespace btr

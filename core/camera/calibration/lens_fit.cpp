#include "core/camera/calibration/lens_fit.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <opencv2/calib3d.hpp>

#include "core/spec/error.h"

namespace btr {
namespace {

cv::Matx33d matrixOf(const LensNumbers& n) { return {n[focal], 0, n[centreX], 0, n[focal], n[centreY], 0, 0, 1}; }
// In OpenCV's order.
cv::Vec<double, 5> termsOf(const LensNumbers& n) { return {n[k1], n[k2], n[p1], n[p2], n[k3]}; }

std::vector<cv::Point3d> pointsOf(const PointView& view) {
  std::vector<cv::Point3d> points;
  for (const auto& p : view.points_m) points.emplace_back(p[0], p[1], p[2]);
  return points;
}

std::vector<cv::Point2d> seenOf(const PointView& view) {
  std::vector<cv::Point2d> seen;
  for (const auto& p : view.seen_px) seen.emplace_back(p[0], p[1]);
  return seen;
}

int calibrationFlags(const std::array<bool, lensNumberCount>& free) {
  int flags = cv::CALIB_USE_INTRINSIC_GUESS | cv::CALIB_FIX_ASPECT_RATIO;
  if (!free[focal]) flags |= cv::CALIB_FIX_FOCAL_LENGTH;
  if (!free[centreX] || !free[centreY]) flags |= cv::CALIB_FIX_PRINCIPAL_POINT;
  if (!free[k1]) flags |= cv::CALIB_FIX_K1;
  if (!free[k2]) flags |= cv::CALIB_FIX_K2;
  if (!free[k3]) flags |= cv::CALIB_FIX_K3;
  if (!free[p1] || !free[p2]) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  return flags;
}

// Zhang's method with all poses free.
LensFit fitWithPoses(std::span<const PointView> views, int width, int height, const LensNumbers& start,
                     const std::array<bool, lensNumberCount>& free) {
  std::vector<std::vector<cv::Point3f>> points;
  std::vector<std::vector<cv::Point2f>> seen;
  for (const PointView& view : views) {
    points.emplace_back();
    seen.emplace_back();
    for (const cv::Point3d& p : pointsOf(view)) points.back().emplace_back(p);
    for (const cv::Point2d& p : seenOf(view)) seen.back().emplace_back(p);
  }
  cv::Mat matrix(matrixOf(start)), terms(termsOf(start)), deviations;
  const cv::TermCriteria patience(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-12);
  try {
    cv::calibrateCamera(points, seen, {width, height}, matrix, terms, cv::noArray(), cv::noArray(), deviations,
                        cv::noArray(), cv::noArray(), calibrationFlags(free), patience);
  } catch (const cv::Exception& error) {
    throw InputError("photographs", "these " + std::to_string(views.size()) + " (" + error.err + ")",
                     "boards seen from several sides");
  }
  // Deviations: fx, fy, cx, cy, k1, k2, p1, p2, k3 …; fx is tied to fy.
  LensFit fit;
  const double values[] = {matrix.at<double>(1, 1), matrix.at<double>(0, 2), matrix.at<double>(1, 2),
                           terms.at<double>(0),     terms.at<double>(1),     terms.at<double>(4),
                           terms.at<double>(2),     terms.at<double>(3)};
  constexpr int places[] = {1, 2, 3, 4, 5, 8, 6, 7};
  for (std::size_t i = 0; i < lensNumberCount; ++i) {
    fit.value[i] = values[i];
    fit.deviation[i] = free[i] ? deviations.at<double>(places[i]) : 0;
  }
  return fit;
}

/// Where a lens puts a point of a known place before the camera, against where it is seen.
struct SeenPoint {
  double x, y;  // ideal, in focal lengths
  double u_px, v_px;

  template <class T>
  bool operator()(const T* f, const T* cx, const T* cy, const T* a, const T* b, const T* c, const T* s, const T* t,
                  T* residual) const {
    const double r2 = x * x + y * y;
    const T radial = 1.0 + r2 * (a[0] + r2 * (b[0] + r2 * c[0]));
    const T dx = x * radial + 2.0 * s[0] * x * y + t[0] * (r2 + 2 * x * x);
    const T dy = y * radial + s[0] * (r2 + 2 * y * y) + 2.0 * t[0] * x * y;
    residual[0] = f[0] * dx + cx[0] - u_px;
    residual[1] = f[0] * dy + cy[0] - v_px;
    return true;
  }
};

std::array<double, 2> idealOf(const ViewPose& pose, const std::array<double, 3>& point) {
  std::array<double, 3> turned{};
  ceres::AngleAxisRotatePoint(pose.rotation_rad.data(), point.data(), turned.data());
  for (std::size_t i = 0; i < 3; ++i) turned[i] += pose.translation_m[i];
  return {turned[0] / turned[2], turned[1] / turned[2]};
}

// Standard deviations: the variance of what is left times the inverse of the normal matrix.
void setDeviations(ceres::Problem& problem, LensFit& fit, const std::array<bool, lensNumberCount>& free,
                   double variance) {
  std::vector<std::pair<const double*, const double*>> diagonal;
  for (std::size_t i = 0; i < lensNumberCount; ++i)
    if (free[i]) diagonal.emplace_back(&fit.value[i], &fit.value[i]);
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = 0;
  ceres::Covariance covariance(options);
  if (!covariance.Compute(diagonal, &problem))
    throw InputError("photographs", "these points", "points all over the picture, which tell all numbers apart");
  for (std::size_t i = 0; i < lensNumberCount; ++i) {
    double square = 0;
    if (free[i]) covariance.GetCovarianceBlock(&fit.value[i], &fit.value[i], &square);
    fit.deviation[i] = std::sqrt(square * variance);
  }
}

LensFit fitAtKnownPoses(std::span<const PointView> views, const LensNumbers& start,
                        const std::array<bool, lensNumberCount>& free) {
  LensFit fit;
  fit.value = start;
  auto& v = fit.value;
  ceres::Problem problem;
  double residuals = 0;
  for (const PointView& view : views)
    for (std::size_t i = 0; i < view.points_m.size(); ++i) {
      const auto ideal = idealOf(*view.pose, view.points_m[i]);
      auto* cost = new ceres::AutoDiffCostFunction<SeenPoint, 2, 1, 1, 1, 1, 1, 1, 1, 1>(
          new SeenPoint{ideal[0], ideal[1], view.seen_px[i][0], view.seen_px[i][1]});
      problem.AddResidualBlock(cost, nullptr, &v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &v[7]);
      residuals += 2;
    }
  double freeCount = 0;
  for (std::size_t i = 0; i < lensNumberCount; ++i) {
    if (!free[i]) problem.SetParameterBlockConstant(&v[i]);
    freeCount += free[i];
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  setDeviations(problem, fit, free, 2 * summary.final_cost / std::max(1.0, residuals - freeCount));
  return fit;
}

// Rotation and translation by OpenCV, from those points whose index is even.
std::pair<cv::Vec3d, cv::Vec3d> poseFromEveryOther(const PointView& view, const LensNumbers& lens) {
  const std::vector<cv::Point3d> points = pointsOf(view);
  const std::vector<cv::Point2d> seen = seenOf(view);
  std::vector<cv::Point3d> used;
  std::vector<cv::Point2d> usedSeen;
  for (std::size_t i = 0; i < points.size(); i += 2) {
    used.push_back(points[i]);
    usedSeen.push_back(seen[i]);
  }
  cv::Vec3d rotation, translation;
  bool found = false;
  try {
    found = cv::solvePnP(used, usedSeen, matrixOf(lens), termsOf(lens), rotation, translation);
  } catch (const cv::Exception&) {
    found = false;
  }
  if (!found) throw InputError(view.name, "its points", "at least twelve points that tell where the camera was");
  return {rotation, translation};
}

}  // namespace

LensFit fitLensNumbers(std::span<const PointView> views, int width, int height, const LensNumbers& start,
                       const std::array<bool, lensNumberCount>& free) {
  return views.front().pose ? fitAtKnownPoses(views, start, free) : fitWithPoses(views, width, height, start, free);
}

double lensError(const PointView& view, const LensNumbers& lens) {
  cv::Vec3d rotation, translation;
  if (view.pose) {
    for (int i = 0; i < 3; ++i) {
      rotation[i] = view.pose->rotation_rad[static_cast<std::size_t>(i)];
      translation[i] = view.pose->translation_m[static_cast<std::size_t>(i)];
    }
  } else {
    std::tie(rotation, translation) = poseFromEveryOther(view, lens);
  }
  std::vector<cv::Point2d> there;
  cv::projectPoints(pointsOf(view), rotation, translation, matrixOf(lens), termsOf(lens), there);
  double square = 0, count = 0;
  for (std::size_t i = view.pose ? 0 : 1; i < there.size(); i += view.pose ? 1 : 2) {
    const double dx = there[i].x - view.seen_px[i][0], dy = there[i].y - view.seen_px[i][1];
    square += dx * dx + dy * dy;
    ++count;
  }
  return std::sqrt(square / count);
}

}  // namespace btr

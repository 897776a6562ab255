#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/gap/fit_model.h"

namespace btr {

/// Which half of the residuals.
enum class Fold { all = -1, first = 0, second = 1 };

struct Linearised;

struct FitOptions {
  int iterations = 20;
  bool startsOnly = false;  ///< the parameters stay; only initial states are fitted
  /// Of a fit whose parameters this model begins with, near where it starts: saves the first differences.
  const Linearised* inherited = nullptr;
  /// Called after each iteration with the share of all that were allowed; false throws Cancelled.
  std::function<bool(double)> goOn = {};
  double tolerance = 3e-4;  ///< ends where an iteration takes a smaller share of the cost
};

/// A model fitted to the recordings.
struct Fit {
  FitModel model;
  std::vector<std::vector<double>> shifts;  ///< of the initial states, by segment and nuisance
  double cost = 0;                          ///< ½ sum of squared residuals, and of the shifts
};

/// Bounded least squares (Levenberg–Marquardt, Ceres) over the model's parameters and each segment's initial state. Far
/// outliers count in proportion to their size only (Huber). Starts from model.values; `shifts` may be empty: zero.
Fit fitModel(const FitProblem& problem, const FitModel& model, const std::vector<std::vector<double>>& shifts,
             const FitOptions& options);

/// The same fit with the initial states of its worst segments (far above the noise, and above most of the others)
/// looked for from elsewhere, too; the parameters stay.
Fit withStartsAnew(const FitProblem& problem, const Fit& fit);

/// Steps of differences: of a parameter, in its scale, the way that stays inside its bounds (`scaled`: its value in
/// scales); of an initial state, in its standard error.
double parameterStep(const FitProblem& problem, const FitParameter& parameter, double scaled);
inline constexpr double startStep = 0.1;

/// All residuals of a fitted model, one segment after the other.
Eigen::VectorXd residualsOf(const FitProblem& problem, const FitModel& model,
                            const std::vector<std::vector<double>>& shifts);

/// Residuals and how they change with the parameters, what initial states explain taken out of both: least squares over
/// the columns is then least squares over parameters and initial states. Columns are per `scale` of their parameter.
struct Linearised {
  Eigen::VectorXd residuals;               ///< as they are
  Eigen::VectorXd profiled;                ///< initial states taken out
  Eigen::MatrixXd columns;                 ///< by residual and parameter, initial states taken out
  std::vector<Eigen::MatrixXd> starts;     ///< by segment: orthonormal columns of what its initial state explains
  Eigen::MatrixXd raw;                     ///< by residual and parameter, as they are
  std::vector<Eigen::MatrixXd> rawStarts;  ///< by segment: by residual and initial state, as they are
  std::vector<Eigen::Index> first;         ///< by segment: its first residual
  /// Takes what initial states explain out of a column.
  Eigen::VectorXd profile(const FitProblem& problem, const Eigen::VectorXd& column) const;
};
Linearised linearise(const FitProblem& problem, const Fit& fit);

/// Standard errors of the parameters from the blocks' scatter (a sandwich: residuals of one block belong together), and
/// the correlations.
struct Uncertainty {
  std::vector<double> standardError;  ///< in the parameter's unit; infinite where the recordings do not tell it
  Eigen::MatrixXd correlation;
  std::vector<double> unsettled;  ///< unsettled(), where it was asked for; else empty

  /// Half the 95 % interval of a parameter, in its unit.
  double half95(std::size_t parameter) const;
};
/// Whether an interval of which this is the half says where a parameter is between its bounds.
bool isTold(const FitParameter& parameter, double half95);
Uncertainty uncertaintyOf(const FitProblem& problem, const Fit& fit, const Linearised& linearised);

/// How far each parameter may still be from where it belongs, beside what noise does, in its unit: the way that the
/// step's integration error, felt as residuals, has pushed it, and the way that a further step of the fit would go.
/// `stepChange`: the fit's residuals less those with half the step.
std::vector<double> unsettled(const FitProblem& problem, const Fit& fit, const Linearised& linearised,
                              const Eigen::VectorXd& stepChange);

/// Mean squared residual of each scoring block, −1 for a block without residuals of this fold.
std::vector<double> blockScores(const FitProblem& problem, const Eigen::VectorXd& residuals, Fold fold);

/// Runs f(0 … count−1) in `jobs` worker processes and returns what each gave, in order; a failed one gives an empty
/// vector. Throws Cancelled when `goOn` says no.
std::vector<std::vector<double>> parallel(int jobs, std::size_t count,
                                          const std::function<std::vector<double>(std::size_t)>& f,
                                          const std::function<bool(std::size_t)>& goOn = {});
/// f(0 … count−1) in the problem's worker processes where about `replays` replays of everything are worth them; a
/// failed one gives an empty vector.
std::vector<std::vector<double>> inWorkers(const FitProblem& problem, std::size_t count, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f);
/// f of every segment, in the problem's worker processes where about `replays` replays of everything are worth them.
std::vector<std::vector<double>> bySegment(const FitProblem& problem, int replays,
                                           const std::function<std::vector<double>(std::size_t)>& f);

}  // namespace btr

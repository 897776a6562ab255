/// Covariance matrix adaptation evolution strategy, (μ/μ_w, λ)-CMA-ES with rank-one and rank-μ update and cumulative
/// step-size adaptation, after Hansen, The CMA Evolution Strategy: A Tutorial (arXiv 1604.00772), with the tutorial's
/// default numbers and weights of the better half only.
///
/// Coordinates u = (p − minimum)/(maximum − minimum), so that a step means the same share of every parameter's range.
///   x_k = m + σ·y_k,  y_k ~ N(0, C);   the better half is weighted by w_1 ≥ … ≥ w_μ > 0, Σw = 1
///   m   ← m + σ·Σ w_i y_i:λ
///   p_σ ← (1 − c_σ)·p_σ + √(c_σ(2 − c_σ)·μ_eff)·C^(−1/2)·Σ w_i y_i:λ
///   σ   ← σ·exp((c_σ/d_σ)·(|p_σ|/E|N(0, I)| − 1))
///   p_c ← (1 − c_c)·p_c + h_σ·√(c_c(2 − c_c)·μ_eff)·Σ w_i y_i:λ
///   C   ← (1 − c_1 − c_μ)·C + c_1·(p_c p_cᵀ + (1 − h_σ)·c_c(2 − c_c)·C) + c_μ·Σ w_i y_i:λ y_i:λᵀ
///
/// Bounds: the search runs in all of ℝⁿ and is folded back into the box like light between mirrors; inside the box
/// nothing changes. Only the order of the fitness counts; a value that is not finite is the worst.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/plugin/plugin.h"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// u folded into [0, 1].
double folded(double u) {
  const double within = std::abs(std::remainder(u, 2.0));
  return std::min(within, 1.0);
}

std::vector<double> list(const auto& matrix) { return {matrix.data(), matrix.data() + matrix.size()}; }

class CovarianceMatrixAdaptation final : public btr::Learner {
 public:
  std::vector<btr::Parameter> settings() const override {
    return {{"population", "", "individuals of a generation; 0: 4 + 3·ln(number of parameters)", 0, 10000, 0, {}, true},
            {"sigma", "", "standard deviation at the start, as a share of each parameter's range", 1e-6, 1, 0.3}};
  }

  void start(std::vector<btr::Parameter> genotype, const btr::Values& values, btr::Random&) override {
    if (genotype.empty()) throw btr::InputError("cma_es", "a genotype without parameters", "at least one parameter");
    const auto value = btr::resolve(settings(), values, "cma_es");
    if (value[0] > 0 && value[0] < 4)
      throw btr::InputError("cma_es/population", btr::toText(value[0]), "0 or at least 4");
    genotype_ = std::move(genotype);
    const auto n = static_cast<double>(genotype_.size());
    lambda_ = value[0] > 0 ? static_cast<std::size_t>(value[0]) : 4 + static_cast<std::size_t>(3 * std::log(n));
    chooseConstants(n);

    const auto size = static_cast<Eigen::Index>(genotype_.size());
    std::vector<double> centre;
    for (const btr::Parameter& p : genotype_) centre.push_back(p.byDefault);
    mean_ = shares(centre);
    sigma_ = value[1];
    covariance_ = MatrixXd::Identity(size, size);
    sigmaPath_ = covariancePath_ = VectorXd::Zero(size);
    asked_.clear();
    generation_ = 1;
    decompose();
  }

  void beginAt(std::span<const double> at, const btr::Permutations&, btr::Random&) override { mean_ = shares(at); }

  std::vector<btr::Candidate> ask(btr::Random& random) override {
    while (asked_.size() < lambda_) {
      VectorXd z(mean_.size());
      for (double& value : z) value = random.normal();
      asked_.push_back(axes_ * (scales_.array() * z.array()).matrix());
    }
    std::vector<btr::Candidate> candidates;
    for (const VectorXd& y : asked_) candidates.push_back({"", parametersAt(mean_ + sigma_ * y)});
    return candidates;
  }

  void tell(std::span<const double> fitness) override {
    if (asked_.empty() || fitness.size() != asked_.size())
      throw btr::InputError(
          "cma_es", std::to_string(fitness.size()) + " fitness values",
          "one for each of the " + std::to_string(asked_.size()) + " individuals that were asked for");
    // Best first; of equal ones the earlier.
    const std::vector<double> known = btr::finiteFitness(fitness);
    std::vector<std::size_t> order(known.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return known[a] > known[b]; });

    const auto n = static_cast<double>(mean_.size());
    VectorXd step = VectorXd::Zero(mean_.size());
    MatrixXd spread = MatrixXd::Zero(mean_.size(), mean_.size());
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const VectorXd& y = asked_[order[i]];
      step += weights_[i] * y;
      spread += weights_[i] * y * y.transpose();
    }
    mean_ += sigma_ * step;
    const VectorXd whitened = axes_ * ((axes_.transpose() * step).array() / scales_.array()).matrix();
    sigmaPath_ = (1 - cSigma_) * sigmaPath_ + std::sqrt(cSigma_ * (2 - cSigma_) * muEff_) * whitened;
    const double begun = 1 - std::pow(1 - cSigma_, 2.0 * static_cast<double>(generation_));
    const double h = sigmaPath_.squaredNorm() / begun / n < 2 + 4 / (n + 1) ? 1 : 0;
    covariancePath_ = (1 - cC_) * covariancePath_ + h * std::sqrt(cC_ * (2 - cC_) * muEff_) * step;
    covariance_ = (1 - c1_ - cMu_ + (1 - h) * c1_ * cC_ * (2 - cC_)) * covariance_ +
                  c1_ * covariancePath_ * covariancePath_.transpose() + cMu_ * spread;
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
    sigma_ *= std::exp(std::min(1.0, cSigma_ / dSigma_ * (sigmaPath_.norm() / expectedNorm_ - 1)));
    asked_.clear();
    ++generation_;
    decompose();
    // More than the whole range says nothing new: a flat fitness must not let the step grow without end.
    sigma_ = std::min(sigma_, 1 / scales_.maxCoeff());
  }

  std::vector<double> centre() const override { return parametersAt(mean_); }

  std::string state() const override {
    nlohmann::json asked = nlohmann::json::array();
    for (const VectorXd& y : asked_) asked.push_back(list(y));
    return nlohmann::json{{"generation", generation_},
                          {"mean", list(mean_)},
                          {"sigma", sigma_},
                          {"covariance", list(covariance_)},
                          {"sigma_path", list(sigmaPath_)},
                          {"covariance_path", list(covariancePath_)},
                          {"asked", asked}}
        .dump();
  }

  void setState(const std::string& state) override {
    try {
      const auto document = nlohmann::json::parse(state);
      const auto numbers = [](const nlohmann::json& from, Eigen::Index rows, Eigen::Index columns) {
        const auto values = from.get<std::vector<double>>();
        if (values.size() != static_cast<std::size_t>(rows * columns))
          throw btr::InputError("cma_es: the stored state does not belong to a search with these settings");
        return MatrixXd(Eigen::Map<const MatrixXd>(values.data(), rows, columns));
      };
      const Eigen::Index n = mean_.size();
      const VectorXd mean = numbers(document.at("mean"), n, 1), sigmaPath = numbers(document.at("sigma_path"), n, 1),
                     covariancePath = numbers(document.at("covariance_path"), n, 1);
      const MatrixXd covariance = numbers(document.at("covariance"), n, n);
      std::vector<VectorXd> asked;
      for (const auto& y : document.at("asked")) asked.push_back(numbers(y, n, 1));
      const auto generation = document.at("generation").get<long>();
      const auto sigma = document.at("sigma").get<double>();
      if (generation < 1 || !(sigma > 0) || (!asked.empty() && asked.size() != lambda_))
        throw btr::InputError("cma_es: the stored state does not belong to a search with these settings");
      mean_ = mean;
      sigmaPath_ = sigmaPath;
      covariancePath_ = covariancePath;
      covariance_ = covariance;
      asked_ = std::move(asked);
      generation_ = generation;
      sigma_ = sigma;
      decompose();
    } catch (const nlohmann::json::exception& error) {
      throw btr::InputError(std::string("cma_es: the stored state is damaged: ") + error.what());
    }
  }

 private:
  void chooseConstants(double n) {
    weights_.assign(lambda_ / 2, 0);
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < weights_.size(); ++i)
      sum += weights_[i] = std::log((static_cast<double>(lambda_) + 1) / 2) - std::log(static_cast<double>(i) + 1);
    for (double& weight : weights_) {
      weight /= sum;
      squares += weight * weight;
    }
    muEff_ = 1 / squares;
    cSigma_ = (muEff_ + 2) / (n + muEff_ + 5);
    dSigma_ = 1 + 2 * std::max(0.0, std::sqrt((muEff_ - 1) / (n + 1)) - 1) + cSigma_;
    cC_ = (4 + muEff_ / n) / (n + 4 + 2 * muEff_ / n);
    c1_ = 2 / ((n + 1.3) * (n + 1.3) + muEff_);
    cMu_ = std::min(1 - c1_, 2 * (muEff_ - 2 + 1 / muEff_) / ((n + 2) * (n + 2) + muEff_));
    expectedNorm_ = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));
  }

  /// C = axes·diag(scales²)·axesᵀ; rounding must not make a variance vanish.
  void decompose() {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance_);
    const double least = 1e-14 * solver.eigenvalues().maxCoeff();
    axes_ = solver.eigenvectors();
    scales_ = solver.eigenvalues().array().max(least).sqrt();
  }

  VectorXd shares(std::span<const double> at) const {
    VectorXd u(static_cast<Eigen::Index>(genotype_.size()));
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const btr::Parameter& p = genotype_[static_cast<std::size_t>(i)];
      const double range = p.maximum - p.minimum;
      u[i] = range > 0 ? std::clamp((at[static_cast<std::size_t>(i)] - p.minimum) / range, 0.0, 1.0) : 0;
    }
    return u;
  }

  std::vector<double> parametersAt(const VectorXd& u) const {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const btr::Parameter& p = genotype_[static_cast<std::size_t>(i)];
      values.push_back(p.minimum + (p.maximum - p.minimum) * folded(u[i]));
    }
    return btr::feasible(genotype_, values);
  }

  std::vector<btr::Parameter> genotype_;
  std::size_t lambda_ = 0;
  std::vector<double> weights_;
  double muEff_ = 0, cSigma_ = 0, dSigma_ = 0, cC_ = 0, c1_ = 0, cMu_ = 0, expectedNorm_ = 0;
  long generation_ = 1;
  double sigma_ = 0;
  VectorXd mean_, sigmaPath_, covariancePath_, scales_;
  MatrixXd covariance_, axes_;
  std::vector<VectorXd> asked_;  ///< steps y of the individuals that wait for their fitness
};

}  // namespace

BTR_LEARNER(CovarianceMatrixAdaptation, "cma_es")

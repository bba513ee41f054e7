#include "tools/accuracy/contact_fit.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace mocap {
namespace {

// Newton's method converges quadratically: thirty steps are plenty. A weak prior keeps the odds
// finite where motion separates the samples perfectly.
constexpr int kNewtonSteps = 30;
constexpr double kPriorInformation = 1e-3;

Vector3 FeaturesOf(const FootMotion& motion) {
  return {1, motion.height_mm, std::log1p(motion.speed_mm_s / kStandingSpeed_mm_s)};
}

double ShareAt(const ContactOdds& odds, const ContactSample& sample) {
  const Vector3 weights(odds.resting, odds.per_mm, odds.per_log_speed);
  return 1 / (1 + std::exp(-weights.dot(FeaturesOf(sample.motion))));
}

std::vector<ContactSample> SamplesOf(std::span<const ContactTake> takes, std::size_t first,
                                     std::vector<ContactSample> ContactTake::*part) {
  std::vector<ContactSample> samples;
  for (std::size_t t = first; t < takes.size(); t += 2)
    samples.insert(samples.end(), (takes[t].*part).begin(), (takes[t].*part).end());
  return samples;
}

std::string ContactLine(const std::string& name, std::span<const ContactTake> takes,
                        std::vector<ContactSample> ContactTake::*part) {
  const std::vector<ContactSample> fitted = SamplesOf(takes, 0, part);
  const std::vector<ContactSample> others = SamplesOf(takes, 1, part);
  const ContactOdds odds = FitContactOdds(fitted);
  double right = 0, nats = 0, touching = 0;
  for (const ContactSample& sample : others) {
    const double share = ShareAt(odds, sample);
    right += (share > 0.5) == sample.touches;
    nats -= std::log(std::max(1e-12, sample.touches ? share : 1 - share));
    touching += sample.touches;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, others.size()));
  return fmt::format("| {} | {:.2f} | {:.4f} | {:.2f} | {} | {:.1f} | {:.1f} | {:.3f} |\n", name,
                     odds.resting, odds.per_mm, odds.per_log_speed, fitted.size(),
                     100 * touching / count, 100 * right / count, nats / count);
}

}  // namespace

ContactOdds FitContactOdds(std::span<const ContactSample> samples) {
  ContactOdds odds{0, 0, 0};
  for (int step = 0; step < kNewtonSteps; ++step) {
    Matrix3 information = kPriorInformation * Matrix3::Identity();
    Vector3 gradient = -kPriorInformation * Vector3(odds.resting, odds.per_mm, odds.per_log_speed);
    for (const ContactSample& sample : samples) {
      const Vector3 features = FeaturesOf(sample.motion);
      const double share = ShareAt(odds, sample);
      gradient += ((sample.touches ? 1 : 0) - share) * features;
      information += share * (1 - share) * features * features.transpose();
    }
    const Vector3 change = information.ldlt().solve(gradient);
    odds = {odds.resting + change[0], odds.per_mm + change[1], odds.per_log_speed + change[2]};
  }
  return odds;
}

std::string ContactTable(std::span<const ContactTake> takes) {
  return "\n### Contacts with the floor\nLog odds of a contact are `resting + per mm · height + "
         "per "
         "log speed · ln(1 + speed / 30 mm/s)`, where the tracked foot is near the true one. Half "
         "of "
         "the people are fitted, the others check.\n\n"
         "| part | resting | per mm | per log speed | fitted | touching % | right % | nats |\n"
         "|---|---|---|---|---|---|---|---|\n" +
         ContactLine("heel", takes, &ContactTake::heels) +
         ContactLine("toes", takes, &ContactTake::toes);
}

}  // namespace mocap

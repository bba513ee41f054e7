#include "core/objective/contact_term.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mocap {
namespace {

// Rays that miss every part by this much show something else, or a lost limb.
constexpr double kUnexplained_mm = 60;
// Share of all rays. If this many miss the hull and graze a part, its flesh was carved away.
constexpr double kCarvedShare = 1.0 / 60, kGrazes_mm = 40;
// A contact this close to the rest of a body is no evidence for a limb: half of the rays' scale
// more hardly change its cost.
constexpr double kTaken_mm = 20;

// The thing that explains a contact better than the body; empty if there is none.
std::optional<Thing> ThingAt(const ThingPlaces& places, const ContactTerm::Residual& residual,
                             const Contact& contact) {
  return residual.outside_mm > kOfThing_mm ? places.At(contact) : std::nullopt;
}

}  // namespace

void ContactTerm::SetEvidence(const Evidence& evidence, int voxels, int rays, double pose_std_mm) {
  ChooseContacts(evidence, voxels, rays, contacts_);
  moving_.clear();
  rest_mm_.clear();
  Prepare();
  of_rays_ = kRayNoise.Widened(pose_std_mm).Of(rays_, kIndependentRays);
  of_surface_ = kSurfaceNoise.Widened(pose_std_mm).Of(voxels_, kIndependentVoxels);
}

void ContactTerm::Prepare() {
  matcher_.SetSegments(contacts_);
  rays_ = static_cast<int>(std::ranges::count_if(contacts_, &Contact::is_edge));
  voxels_ = static_cast<int>(contacts_.size()) - rays_;
}

void ContactTerm::TakeOpen(ContactTerm& whole, const PosedBody& posed, CapsuleSet moving,
                           CapsuleSet absent, const Things& things) {
  moving_.clear();
  posed_.clear();
  for (int i = 0; i < std::ssize(posed.capsules()); ++i) {
    if (moving >> i & 1)
      moving_.push_back(i);
    else if (!(absent >> i & 1))
      posed_.push_back(posed.capsules()[i]);
  }
  std::optional<ThingPlaces> places;
  if (things.any()) places.emplace(posed.body(), posed.posture(), things);
  const std::vector<SegmentMatch>& matches = whole.matcher_.Match(posed_, kReach_mm);
  contacts_.clear();
  rest_mm_.clear();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Contact& contact = whole.contacts_[i];
    double rest_mm = matches[i].capsule < 0 ? kReach_mm : matches[i].distance.outside_mm;
    if (std::abs(rest_mm) < kTaken_mm) continue;
    if (places && rest_mm > kOfThing_mm && places->At(contact)) rest_mm = kOfThing_mm;
    contacts_.push_back(contact);
    rest_mm_.push_back(rest_mm);
  }
  Prepare();
  of_rays_ = whole.of_rays_;
  of_surface_ = whole.of_surface_;
}

const std::vector<SegmentMatch>& ContactTerm::Match(const PosedBody& posed) {
  posed_.clear();
  for (const int i : moving_) posed_.push_back(posed.capsules()[i]);
  return matcher_.Match(moving_.empty() ? posed.capsules() : posed_, kReach_mm);
}

double ContactTerm::SavedBy(const Residual& residual) const {
  const ResidualNoise& noise = NoiseOf(residual.is_ray);
  return noise.NatsAt(residual.outside_mm) - noise.NatsAt(kOfThing_mm);
}

ContactNats ContactTerm::At(const PosedBody& posed, const Things& things) {
  std::optional<ThingPlaces> places;
  if (things.any() && moving_.empty()) places.emplace(posed.body(), posed.posture(), things);
  ContactNats nats;
  LogSum of_rays, of_missing, of_surface;
  int touching = 0;
  std::array<double, kThingCount> saved{};
  int unexplained = 0;
  ForEach(posed, [&](const Residual& residual, const Contact& contact) {
    const ResidualNoise& noise = NoiseOf(residual.is_ray);
    (!residual.is_ray      ? of_surface
     : contact.misses_hull ? of_missing
                           : of_rays)
        .Add(noise.ScaledSquare(residual.outside_mm));
    touching += residual.is_ray && !contact.misses_hull;
    unexplained += residual.is_ray && residual.outside_mm > kUnexplained_mm;
    if (!residual.is_ray) nats.surface_mm += std::abs(residual.outside_mm) / voxels_;
    if (!places) return;
    if (const auto thing = ThingAt(*places, residual, contact))
      saved[static_cast<int>(*thing)] += SavedBy(residual);
  });
  const double hit = of_rays.Sum(), surface = of_surface.Sum();
  nats.rays = of_rays_.NatsOf(hit + of_missing.Sum());
  nats.surface = of_surface_.NatsOf(surface);
  const auto share = [](double sum, int count, const ResidualNoise& noise) {
    return sum / (std::max(1, count) * std::log1p(noise.ScaledSquare(kReach_mm)));
  };
  nats.misfit =
      touching > 0 ? share(hit, touching, of_rays_) : share(surface, voxels_, of_surface_);
  nats.unexplained_share = static_cast<double>(unexplained) / std::max(1, rays_);
  for (int i = 0; i < kThingCount; ++i) {
    if (saved[i] <= kThingNats) continue;
    nats.shown.set(i);
    nats.things -= saved[i] - kThingNats;
  }
  return nats;
}

void ContactTerm::Linearize(const PosedBody& posed, const Things& things, Linearisation& sums) {
  std::optional<ThingPlaces> places;
  if (things.any() && moving_.empty()) places.emplace(posed.body(), posed.posture(), things);
  std::array<double, kThingCount> saved{};
  of_things_.clear();
  const auto add = [&](const Residual& residual) {
    sums.chain.Add(posed.CarrierOf(residual.capsule), residual.p_W, residual.normal_W,
                   residual.outside_mm, NoiseOf(residual.is_ray).VarianceAt(residual.outside_mm));
  };
  ForEach(posed, [&](const Residual& residual, const Contact& contact) {
    const auto thing = places ? ThingAt(*places, residual, contact) : std::nullopt;
    if (thing) saved[static_cast<int>(*thing)] += SavedBy(residual);
    if (residual.capsule < 0) return;
    if (thing) {
      of_things_.emplace_back(*thing, residual);
    } else {
      add(residual);
    }
  });
  // What things explain does not pull, if they are worth their cost.
  for (const auto& [thing, residual] : of_things_)
    if (saved[static_cast<int>(thing)] <= kThingNats) add(residual);
}

CapsuleSet ContactTerm::CarvedAway() const {
  std::array<int, SegmentMatcher::kMostCapsules> grazing{};
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const SegmentMatch& match = matcher_.matches()[i];
    if (contacts_[i].misses_hull && match.capsule >= 0 &&
        std::abs(match.distance.outside_mm) < kGrazes_mm)
      ++grazing[moving_.empty() ? match.capsule : moving_[match.capsule]];
  }
  CapsuleSet carved = 0;
  for (std::size_t k = 0; k < grazing.size(); ++k)
    if (grazing[k] >= std::max(2.0, kCarvedShare * rays_)) carved |= CapsuleSet{1} << k;
  return carved;
}

}  // namespace mocap

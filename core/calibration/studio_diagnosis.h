// §4, beyond the paper: what the cameras' silhouettes of people say about a calibration.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/calibration/person_extent.h"
#include "core/calibration/seen_shape.h"
#include "core/calibration/view_agreement.h"

namespace mocap {

/// What keeps the cameras from seeing one person in one place.
enum class StudioFault {
  kNone,
  kExchanged,     ///< Two cameras deliver each other's pictures.
  kUpsideDown,    ///< A camera's picture is rotated by 180 degrees.
  kMirrored,      ///< A camera's picture has left and right exchanged.
  kSomeDisagree,  ///< The others agree without these cameras.
  kNoneAgree,     ///< No majority of the cameras agrees.
  kUnit,          ///< Lengths are not in millimetres.
  kFloor,         ///< The person's feet are not at z = 0.
  kStature,       ///< The person is larger or smaller than people are.
};

/// Agreement of two cameras over several moments.
struct PairAgreement {
  std::size_t first = 0, second = 0;  ///< Indices of the cameras.
  int moments = 0;                    ///< Those in which both could be compared.
  ViewAgreement views;                ///< Medians; meaningful if moments > 0.
};

struct StudioDiagnosis {
  StudioFault fault = StudioFault::kNone;
  std::vector<std::size_t> cameras;  ///< Indices of those that the fault concerns, ascending.
  double unit_mm = 1;                ///< Of kUnit: the likely length of the calibration's unit.
  std::vector<PairAgreement> pairs;  ///< All pairs, as the cameras are calibrated.
  PersonExtent person;               ///< By the cameras that agree.
};

/// Whether most of the cameras show something of a person's size.
bool ShowsPerson(const SeenMoment& moment);

/// Whether what most of the cameras show moves between these moments, unlike furniture. Heads may
/// turn meanwhile.
bool Moves(std::span<const CameraCalibration> cameras, std::span<const SeenMoment> moments);

/// Whether the cameras themselves are at fault, however many people there are and whatever their
/// statures.
bool IsOfCameras(StudioFault fault);

/// Finds the fault that explains the silhouettes of some moments with the fewest assumptions.
/// @param cameras  of the moments' entries, in their order.
/// @return  kNone also if too little is seen to tell.
StudioDiagnosis Diagnose(std::span<const CameraCalibration> cameras,
                         std::span<const SeenMoment> moments);

}  // namespace mocap

#include "tools/view/status_json.h"

#include "daemon/status/status_fields.h"

namespace mocap {
namespace {

template <typename Of>
void Judge(std::span<const StatusField<Of>> fields, const Of& of, Json& json) {
  json["poor"] = Json::array();
  for (const StatusField<Of>& field : fields) {
    if (field.key.empty()) continue;
    if (!field.IsKnown(of)) json[std::string(field.key)] = nullptr;
    if (field.IsPoor(of)) json["poor"].push_back(field.key);
  }
}

}  // namespace

std::string StatusJson(const ServiceReport& report) {
  Json json = ObjectOf(ServiceFields(), report);
  json["type"] = "status";
  Judge(ServiceFields(), report, json);
  const std::vector<ReportedCamera> cameras = CamerasOf(report);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    Judge(CameraFields(), cameras[i], json["cameras"][i]);
  for (std::size_t i = 0; i < report.keypoints.senders.size(); ++i)
    Judge(KeypointFields(), report.keypoints.senders[i], json["keypoints"][i]);
  return JsonText(json);
}

}  // namespace mocap

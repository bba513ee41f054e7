#include "tools/report/extremity_text.h"

#include <fmt/format.h>

#include "tools/report/report_page.h"

namespace mocap {
namespace {

/// Visits the parts of the feet of which contacts or stances are known.
template <typename Visit>
void ForEachPart(const ExtremityAccuracy& accuracy, Visit visit) {
  for (std::size_t part = 0; part < kFootPartNames.size(); ++part)
    if (!accuracy.contacts[part].IsEmpty() || accuracy.true_skating[part].stances > 0)
      visit(std::string(kFootPartNames[part]), accuracy.contacts[part], accuracy.skating[part],
            accuracy.true_skating[part]);
}

std::string ShareText(const ContactScore& score, double share) {
  return score.IsEmpty() ? "-" : fmt::format("{:.3f}", share);
}

std::string FiguresText(const std::string& what, const std::string& unit, int decimals,
                        const std::vector<FigureErrors>& figures) {
  std::string text = fmt::format("  {:<18}{:>14}{:>12}\n", what, "mean " + unit, "95 % below");
  for (const FigureErrors& one : figures)
    text += fmt::format("  {:<18}{:>14.{}f}{:>12.{}f}\n", one.name, one.mean, decimals, one.p95,
                        decimals);
  return text;
}

Json FiguresJson(const std::vector<FigureErrors>& figures) {
  Json json = Json::object();
  for (const FigureErrors& one : figures)
    json[one.name] = {{"mean", Rounded(one.mean, 2)}, {"p95", Rounded(one.p95, 2)}};
  return json;
}

Json FiguresTable(const std::string& what, const std::string& unit,
                  const std::vector<FigureErrors>& figures) {
  Json rows = Json::array();
  for (const FigureErrors& one : figures)
    rows.push_back({one.name, NumberOrNull(one.mean), NumberOrNull(one.p95)});
  return Table({{what}, {"mean " + unit, 1, true}, {"95 % below", 1}}, rows);
}

Json ContactJson(const ContactScore& score) {
  return {{"f1", Rounded(score.F1(), 4)},
          {"precision", Rounded(score.Precision(), 4)},
          {"recall", Rounded(score.Recall(), 4)}};
}

Json SkatingJson(const Skating& skating, const Skating& truth) {
  return {{"stances", skating.stances},
          {"frame_p95", Rounded(skating.frame_p95_mm, 2)},
          {"stance_mean", Rounded(skating.stance_mean_mm, 2)},
          {"stance_p95", Rounded(skating.stance_p95_mm, 2)},
          {"true_frame_p95", Rounded(truth.frame_p95_mm, 2)},
          {"true_stance_mean", Rounded(truth.stance_mean_mm, 2)}};
}

std::string FeetText(const ExtremityAccuracy& accuracy) {
  std::string text;
  ForEachPart(accuracy, [&](const std::string& part, const ContactScore& score,
                            const Skating& skating, const Skating& truth) {
    text +=
        fmt::format("  {:<10}{:>7}{:>11}{:>8}{:>15.2f}{:>15.1f}{:>13.1f}{:>22.2f} / {:.1f}\n", part,
                    ShareText(score, score.F1()), ShareText(score, score.Precision()),
                    ShareText(score, score.Recall()), skating.frame_p95_mm, skating.stance_mean_mm,
                    skating.stance_p95_mm, truth.frame_p95_mm, truth.stance_mean_mm);
  });
  if (text.empty()) return text;
  return fmt::format("\n  {:<10}{:>7}{:>11}{:>8}{:>15}{:>15}{:>13}{:>27}\n", "contact", "F1",
                     "precision", "recall", "95 % mm/frame", "mean mm/stance", "95 % below",
                     "true mm/frame, /stance") +
         text;
}

}  // namespace

std::string ExtremityText(const ExtremityAccuracy& accuracy) {
  if (accuracy.IsEmpty()) return {};
  std::string text = "\nhands, feet and head\n" + FiguresText("point", "mm", 1, accuracy.points_mm);
  if (!accuracy.angles_deg.empty())
    text += '\n' + FiguresText("angle", "degrees", 1, accuracy.angles_deg);
  return text + FeetText(accuracy);
}

Json ExtremityJson(const ExtremityAccuracy& accuracy) {
  Json json{{"points_mm", FiguresJson(accuracy.points_mm)},
            {"angles_deg", FiguresJson(accuracy.angles_deg)},
            {"contacts", Json::object()},
            {"skating_mm", Json::object()}};
  ForEachPart(accuracy, [&](const std::string& part, const ContactScore& score,
                            const Skating& skating, const Skating& truth) {
    if (!score.IsEmpty()) json["contacts"][part] = ContactJson(score);
    if (skating.stances > 0) json["skating_mm"][part] = SkatingJson(skating, truth);
  });
  return json;
}

std::string ExtremityMarkdown(const std::string& heading, const ExtremityAccuracy& accuracy) {
  if (accuracy.IsEmpty()) return {};
  return '\n' + heading + "\nMeans over the takes; contacts are counted together.\n\n```" +
         ExtremityText(accuracy) + "```\n";
}

Json ExtremitySections(const ExtremityAccuracy& accuracy) {
  if (accuracy.IsEmpty()) return Json::array();
  Json rows = Json::array();
  ForEachPart(accuracy, [&](const std::string& part, const ContactScore& score,
                            const Skating& skating, const Skating& truth) {
    const auto share = [&](double value) { return score.IsEmpty() ? Json() : NumberOrNull(value); };
    rows.push_back({part, share(score.F1()), share(score.Precision()), share(score.Recall()),
                    NumberOrNull(skating.frame_p95_mm), NumberOrNull(skating.stance_mean_mm),
                    NumberOrNull(truth.frame_p95_mm), NumberOrNull(truth.stance_mean_mm)});
  });
  Json sections = {Heading("Hands, feet and head"),
                   Beside({Json::array({FiguresTable("point", "mm", accuracy.points_mm)}),
                           Json::array({FiguresTable("angle", "°", accuracy.angles_deg)})})};
  if (rows.empty()) return sections;
  sections.push_back(Table({{"contact"},
                            {"F1", 3},
                            {"precision", 3},
                            {"recall", 3},
                            {"95 % mm/frame", 2},
                            {"mean mm/stance", 1},
                            {"true mm/frame", 2},
                            {"true mm/stance", 1}},
                           rows));
  sections.push_back(Paragraph(fmt::format(
      "Contact may begin or end {:.0f} ms early or late. Millimetres: how far the point of a foot "
      "that truly stands moves along the floor, from frame to frame (95 % below) and from where "
      "the stance began. True points roll, too.",
      1000 * kContactTolerance_s)));
  return sections;
}

}  // namespace mocap

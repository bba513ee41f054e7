// Beyond the paper: decides between two bodies that face opposite ways.
#pragma once

namespace mocap {

/// Sums over frames how much less the first of two bodies costs than the second. Who stands still
/// in a skirt looks nearly the same from behind, and shows the right way only later.
class FacingDuel {
 public:
  /// Adds a frame. @param lead_mm  how much less the first body costs.
  void Add(double lead_mm, double dt_s);
  /// Exchanges the two.
  void Swap() { lead_mm_s_ = -lead_mm_s_; }
  /// Whether the second body has cost less so far.
  bool second_leads() const { return lead_mm_s_ < 0; }
  /// Whether it is clear which is right, or has taken too long.
  bool is_over() const;

 private:
  int frames_ = 0;
  double lead_mm_s_ = 0;
  double age_s_ = 0;
};

}  // namespace mocap

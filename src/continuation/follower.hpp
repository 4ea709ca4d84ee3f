#pragma once
/// What follows a branch, point by point. Steps and what is looked for between points: branch.cpp; changes of events:
/// follower_changes.cpp; onsets of chatter: follower_onsets.cpp.
#include "change/death.hpp"
#include "change/onset.hpp"
#include "change/unfold.hpp"
#include "continuation/special.hpp"
#include "orbit/extent.hpp"
#include "orbit/path.hpp"
#include "orbit/record.hpp"
#include "slapstick/continuation/branch.hpp"

namespace slapstick::orbit {

/// Follows one direction from a point.
class Follower {
 public:
  Follower(const Problem& problem, const ContinuationOptions& options, Branch& branch)
      : problem_(problem), options_(options), range_(options.to - options.from), branch_(branch) {}

  void run(PathPoint at);

 private:
  static constexpr double structure = 1e-5;  ///< of the range: at its end the model may have another structure
  [[nodiscard]] double value(const PathPoint& point) const { return point.orbit.parameter(); }
  /// The smallest step near the onset of a chatter: nearer to it the equations, of ever more impacts, become singular.
  [[nodiscard]] double shortest_step() const {
    return branch_.points.back().chatter ? std::max(1e-6, options_.shortest_step) : options_.shortest_step;
  }
  [[nodiscard]] bool inside(double v) const { return v >= options_.from && v <= options_.to; }
  [[nodiscard]] Solution solution_of(const PathPoint& point, Verification* seen) const;
  /// Is there a point before the last, with the events of this one?
  [[nodiscard]] bool has_before(const PathPoint& at) const {
    return before_ && before_->point.orbit.shape.legs == at.orbit.shape.legs;
  }
  bool accept(PathPoint& at, PathPoint next, double length);
  [[nodiscard]] std::optional<Change> first_change(const PathPoint& at, const PathPoint& beyond, double length) const;
  [[nodiscard]] bool at_end(double place, double error, const PathPoint& at) const;
  bool look_nearer(PathPoint& at, double length, const std::string& why);
  bool change_events(PathPoint& at, const PathPoint& beyond, double length, const std::string& why);
  /// A special point on the way: the onset of a chatter, or a change of events.
  struct Place {
    double value = 0.0, error = 0.0;
    bool onset = false;
  };
  /// @param way  set to the way from the first orbit beyond the change back to it, if other changes lie between
  [[nodiscard]] Unfolding look_beyond(const PathPoint& at, const Change& change, std::optional<Branch>& way) const;
  [[nodiscard]] std::optional<bool> lead_back(const Change& change, const HalfBranch& found, double error,
                                              std::optional<Branch>& way) const;
  [[nodiscard]] bool leads_back(const Unfolding& beyond) const;
  bool pass(PathPoint& at, Change change);
  bool end_at_others(const PathPoint& at, SpecialPoint special, Unfolding beyond);
  bool end_at(const PathPoint& at, SpecialPoint special);
  void name_by_both_sides(const PathPoint& at, const Change& change, const Orbit& behind, SpecialPoint& special) const;
  void go_on(PathPoint& at, SpecialPoint special, HalfBranch next, std::optional<Branch> between);
  bool leave_chatter(PathPoint& at);
  [[nodiscard]] std::vector<HalfBranch> clear_of_onset(const PathPoint& at) const;
  bool leave_knot(PathPoint& at, SpecialPoint special);
  void place_at_knot(SpecialPoint& special, const Orbit& chattering, double within) const;
  bool leave_clear_of_onset(PathPoint& at);
  bool meet_onset(PathPoint& at);
  [[nodiscard]] bool in_gathering(const PathPoint& at, const Change& change) const;
  [[nodiscard]] std::optional<PlaceLimit> onset_ahead(const PathPoint& at);
  [[nodiscard]] std::optional<CascadeLimit> cascade() const;
  [[nodiscard]] std::optional<CascadeLimit> cascade_ends(const PathPoint& at) const;
  bool end_cascade(PathPoint& at);
  bool end_cascade_with(PathPoint& at, SpecialPoint last);
  bool turn_round(PathPoint& at);
  bool clear_onset(PathPoint& at);
  bool die_out(PathPoint& at);
  bool leave_edge(PathPoint& at);
  bool try_ways_on(PathPoint& at);
  void add_here(SpecialPoint special);
  struct ReturnPath {
    Branch branch;
    std::optional<SpecialPoint> place;  ///< as it was come to
  };
  [[nodiscard]] std::optional<ReturnPath> follow_back(const PathPoint& from, const Place& place) const;
  void add_between(Branch way);
  void arrive(SpecialPoint special);
  void set_out(PathPoint& at, PathPoint from);
  bool enter_cascade(PathPoint& at, SpecialPoint special, const PathPoint& from);
  void restart(PathPoint& at, PathPoint from);
  void look_for_pairs(const PathPoint& at, const PathPoint& next, double length);
  void add(std::vector<SpecialPoint> smooth, std::size_t after);
  bool end_at_boundary(PathPoint& at);
  bool end_of_model(const PathPoint& at);
  [[nodiscard]] bool shrinks_to_equilibrium(const SpecialPoint& special) const;
  [[nodiscard]] bool passes_nothing(const SpecialPoint& special) const;
  [[nodiscard]] bool stays_in_one_mode(const Orbit& orbit) const;
  bool runs_over_itself();
  bool grows_without_bound(const PathPoint& at);
  void close();
  [[nodiscard]] bool has_come_round(const Extent& extent, const Orbit& first) const;
  void end(BranchEnd::Kind why);
  void fail(BranchEnd end);

  const Problem& problem_;
  const ContinuationOptions& options_;
  double range_;
  Branch& branch_;
  struct Before {
    PathPoint point;
    double length;  ///< from there to the next one
  };
  std::optional<Before> before_;
  /// The first point beyond the onset of a chatter, in the other direction, and what the branch had then.
  struct Onset {
    PathPoint other_way;
    std::size_t points, special;
    int chatters;  ///< of its orbit
  };
  std::optional<Onset> onset_;
  double step_ = 0.0;
  int old_points_ = 0;            ///< latest points that lie on the branch as it was followed before
  std::optional<Place> back_to_;  ///< followed as far as there only
  /// The onset of a complete chatter ahead, once it is known, and the legs of the orbit from which it was last looked
  /// for.
  mutable std::optional<PlaceLimit> ahead_;
  std::size_t looked_from_ = 0;
  bool ended_ = false;
};

}  // namespace slapstick::orbit

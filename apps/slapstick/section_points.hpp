#pragma once
/// The points of a section of a motion: into a table and a picture.
#include "axis_units.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "slapstick/quantity/reader.hpp"
#include "slapstick/section/event_section.hpp"
#include "stop_options.hpp"
#include "verb.hpp"

namespace slapstick::app {

/// What the command line says.
struct PoincareOptions {
  ModelOptions model;
  StopOptions stops;
  std::string section = "impact", event, of, out, plot, plot_size;
  double phase = 0.0;
  long long transient = 500, points = 1000, most_periods = 1'000'000, patience = 10'000;
  bool progress = false;
};

/// What a section gave.
struct Found {
  long long points = 0;
  bool whole = true;  ///< false: stopped before its end
  bool map = false;   ///< the picture is a return map
  figure::Panel panel;
};

/// The quantities of --of: further columns, and where there are two or more the axes of the picture.
class PointQuantities {
 public:
  /// @throws InputError naming --of
  PointQuantities(const std::string& of, const ChosenModel& chosen, const System& system);
  [[nodiscard]] const std::vector<Quantity>& of() const { return reader_.of(); }
  [[nodiscard]] bool are_axes() const { return of().size() > 1; }
  /// The values just before the motion's last event, or where it stands.
  [[nodiscard]] const std::vector<double>& before(const Motion& motion) { return reader_.before(motion); }
  [[nodiscard]] const std::vector<double>& now(const Motion& motion) { return reader_.now(motion); }
  /// Names the axes of a panel.
  void label(figure::Panel& panel) const;

 private:
  Reader reader_;
};

/// Each runs the transient, then writes points until there are enough, or none comes for `patience` periods.
/// @throws NumericalError if there is no point
[[nodiscard]] Found impact_points(const PoincareOptions& options, const StopChoice& stops, Motion motion,
                                  TableOutput& table, const AxisUnits& units, PointQuantities& of,
                                  const Context& context);
[[nodiscard]] Found strobe_points(const PoincareOptions& options, const StopChoice& stops, Motion motion,
                                  TableOutput& table, const AxisUnits& units, PointQuantities& of,
                                  const Context& context);
[[nodiscard]] Found event_points(const PoincareOptions& options, const EventChoice& events, Motion motion,
                                 TableOutput& table, const AxisUnits& units, PointQuantities& of,
                                 const Context& context);

}  // namespace slapstick::app

#pragma once
/// diagram --y: statistics of quantities over a parameter, as a table and as panels.
#include "figure/figure.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "slapstick/sweep/diagram.hpp"
#include "span_options.hpp"

namespace slapstick::app {

class MeasuredDiagram {
 public:
  /// @param y  "Q:STAT,..". @throws InputError naming --y
  MeasuredDiagram(const ChosenModel& chosen, const std::string& y, const Sweep& sweep);

  [[nodiscard]] std::vector<Quantity> of() const;
  [[nodiscard]] std::vector<std::string> columns() const;
  /// The columns that have a panel.
  [[nodiscard]] std::vector<std::string> shown() const;
  /// A row for each value that did not fail. If every value has failed, no table is made.
  void write(const sweep::Diagram& diagram, TableOutput& table) const;
  [[nodiscard]] figure::Figure figure(const sweep::Diagram& diagram) const;

 private:
  const ChosenModel& chosen_;
  const Sweep& sweep_;
  std::vector<Wanted> wanted_;
};

/// "F_stop:rms", with the unit of the statistic where it has one, as the text of an axis.
[[nodiscard]] std::string statistic_axis(const Wanted& wanted);

/// Reads "Q:STAT,.."; each with a statistic. @throws InputError naming the argument
[[nodiscard]] std::vector<Wanted> parse_statistics(const std::string& argument, const std::string& text,
                                                   const ChosenModel& chosen);

}  // namespace slapstick::app

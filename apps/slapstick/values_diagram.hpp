#pragma once
/// diagram --y Q without a statistic: values of quantities at instants over a parameter, as a table and as clouds.
#include "figure/figure.hpp"
#include "model_options.hpp"
#include "output.hpp"
#include "parameter_ranges.hpp"
#include "slapstick/sweep/diagram.hpp"

namespace slapstick::app {

class ValuesDiagram {
 public:
  /// @param y  "Q,.."
  /// @param at  "impact", "period", an event as of `poincare --event`, or "": impact, without stops period
  /// @throws InputError naming --y or --at
  ValuesDiagram(const ChosenModel& chosen, const std::string& y, const std::string& at, const Sweep& sweep);

  /// Asks for what is shown.
  void complete(sweep::DiagramProblem& problem) const;
  [[nodiscard]] std::vector<std::string> columns() const;
  /// The columns that have a panel.
  [[nodiscard]] std::vector<std::string> shown() const;
  /// A row for each instant. If every value has failed, no table is made.
  void write(const sweep::Diagram& diagram, TableOutput& table) const;
  /// A panel for each quantity.
  [[nodiscard]] figure::Figure figure(const sweep::Diagram& diagram) const;
  /// What its rows are: "impact", "period", "stick".
  [[nodiscard]] const std::string& noun() const { return noun_; }

 private:
  const ChosenModel& chosen_;
  const Sweep& sweep_;
  std::vector<Quantity> of_;
  sweep::InstantChoice instants_;
  std::string noun_;
};

/// Has one of the words of --y a statistic? @throws InputError if some have and others have none
[[nodiscard]] bool are_statistics(const std::string& y);

}  // namespace slapstick::app

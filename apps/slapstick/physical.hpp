#pragma once
/// --physical: tables in physical units, by the model's [scale].
#include <string>
#include <vector>

#include "model_options.hpp"

namespace slapstick::app {

/// Factors and headings of a table's columns: those of [scale], or 1 and bare names.
class TableUnits {
 public:
  /// @throws InputError if `physical` and the model has no [scale]
  TableUnits(const ChosenModel& chosen, bool physical);

  [[nodiscard]] std::vector<std::string> event_columns() const;
  [[nodiscard]] std::vector<std::string> trajectory_columns() const;

  [[nodiscard]] double time(double value) const { return units_.time.factor * value; }
  [[nodiscard]] double w(double value) const { return units_.w.factor * value; }
  /// The same numbers in the table's units; valid until the next call.
  template <class Numbers>
  [[nodiscard]] const std::vector<double>& state(const Numbers& numbers) {
    return converted(numbers, units_.state);
  }
  template <class Numbers>
  [[nodiscard]] const std::vector<double>& observables(const Numbers& numbers) {
    return converted(numbers, units_.observables);
  }

 private:
  template <class Numbers>
  const std::vector<double>& converted(const Numbers& numbers, const std::vector<PhysicalUnits::Column>& columns) {
    numbers_.resize(columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) numbers_[i] = columns[i].factor * numbers[i];
    return numbers_;
  }
  void add_headings(std::vector<std::string>& to, const std::vector<std::string>& names,
                    const std::vector<PhysicalUnits::Column>& columns) const;

  PhysicalUnits units_;
  std::vector<std::string> states_, observables_;
  std::vector<double> numbers_;
};

}  // namespace slapstick::app

#pragma once
/// Units on the axes of pictures, where the model's file states what its numbers are in.
#include <string>
#include <vector>

#include "relative_motion.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::app {

/// "text [unit]"; the text alone if there is no unit.
[[nodiscard]] std::string with_unit(const std::string& text, const std::string& unit);

class AxisUnits {
 public:
  AxisUnits(const ModelDefinition& definition, const Model& model)
      : stated_(definition.stated_units()), model_(model) {}

  /// Of the displacement between two coordinates, of which one may be the ground; empty where it is not stated.
  [[nodiscard]] std::string displacement(int a, int b) const;
  [[nodiscard]] std::string velocity(int a, int b) const { return over_time(displacement(a, b)); }
  /// Of y between these sides: a ratio may have any unit.
  [[nodiscard]] std::string displacement(const Sides& of) const {
    return has_ratio(of) ? "" : displacement(of.a, of.b);
  }
  [[nodiscard]] std::string velocity(const Sides& of) const { return over_time(displacement(of)); }
  /// Of w at these contacts (System::contact_name), if it is the same at all.
  [[nodiscard]] std::string speed(const std::vector<int>& contacts) const;
  [[nodiscard]] const std::string& time() const { return stated_.time; }

 private:
  [[nodiscard]] std::string over_time(const std::string& displacement) const;

  StatedUnits stated_;
  const Model& model_;
};

}  // namespace slapstick::app

#pragma once
/// Edits of a model file that change nothing of its mechanics. docs/developers/campaigns.md has their table.
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "neutral/file.hpp"
#include "random.hpp"

namespace slapstick::neutral {

/// How the answers of the second file follow from those of the first.
struct Rule {
  bool bits = false;                            ///< to the last bit; else to rounding
  double length = 1.0, time = 1.0, mass = 1.0;  ///< a number of the second file is that of the first times these
  bool mirrored = false;                        ///< displacements and velocities of coordinates have the other sign
  std::string prefix;                           ///< before every name
  std::set<std::string> rows_apart;             ///< parts whose events are not compared
  std::string twin;         ///< the model is there twice, once with this behind every name; "": once
  bool joined = false;      ///< the twins act on each other where they move apart
  int steps = 0;            ///< the clock is later by this many instants of `sample_grid`
  double farthest = 1.0;    ///< a pair's only stop may be so far away, and the pair is rounded so
  int more_directions = 0;  ///< multipliers or eigenvalues that the first answer has not
  std::string scaled;       ///< the displacement and velocity of this coordinate ..
  double by = 1.0;          ///< .. are those of the first times this
};

struct Edited {
  Definition file;
  Rule rule;
};

struct Edit {
  const char* name;
  const char* meaning;
  /// Nothing where the file has nothing to edit.
  std::optional<Edited> (*apply)(const Definition& file, campaign::Random& random);
};

[[nodiscard]] const std::vector<Edit>& edits();

/// Lengths, times and masses are these times those of the file.
[[nodiscard]] Edited in_units(const Definition& file, double length, double time, double mass);
/// @throws std::out_of_range
[[nodiscard]] const Edit& find_edit(const std::string& name);

/// The instants at which a motion is looked at are multiples of this, in time units.
[[nodiscard]] double sample_grid(const Model& model);

std::optional<Edited> other_order_of_coordinates(const Definition& file, campaign::Random& random);
std::optional<Edited> other_order_of_links(const Definition& file, campaign::Random& random);
std::optional<Edited> other_order_of_contacts(const Definition& file, campaign::Random& random);
std::optional<Edited> other_names(const Definition& file, campaign::Random& random);
std::optional<Edited> units_of_two(const Definition& file, campaign::Random& random);
std::optional<Edited> other_units(const Definition& file, campaign::Random& random);
std::optional<Edited> parallel_springs(const Definition& file, campaign::Random& random);
std::optional<Edited> collinear_corner(const Definition& file, campaign::Random& random);
std::optional<Edited> constant_as_parameter(const Definition& file, campaign::Random& random);
std::optional<Edited> force_as_base(const Definition& file, campaign::Random& random);
std::optional<Edited> pressed_by_one(const Definition& file, campaign::Random& random);
std::optional<Edited> friction_as_freewheel(const Definition& file, campaign::Random& random);
std::optional<Edited> far_stop(const Definition& file, campaign::Random& random);
std::optional<Edited> far_pad(const Definition& file, campaign::Random& random);
std::optional<Edited> far_compliant_stop(const Definition& file, campaign::Random& random);
std::optional<Edited> zero_force(const Definition& file, campaign::Random& random);
std::optional<Edited> zero_tone(const Definition& file, campaign::Random& random);
std::optional<Edited> zero_signal(const Definition& file, campaign::Random& random);
std::optional<Edited> zero_impulse(const Definition& file, campaign::Random& random);
std::optional<Edited> machine_at_rest(const Definition& file, campaign::Random& random);
std::optional<Edited> twin_machine(const Definition& file, campaign::Random& random);
std::optional<Edited> joined_twin(const Definition& file, campaign::Random& random);
std::optional<Edited> mirror(const Definition& file, campaign::Random& random);
std::optional<Edited> lever(const Definition& file, campaign::Random& random);
std::optional<Edited> later_clock(const Definition& file, campaign::Random& random);
std::optional<Edited> written_by_show(const Definition& file, campaign::Random& random);

}  // namespace slapstick::neutral

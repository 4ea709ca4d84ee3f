/// The table of what can be measured: patterns of names, kinds and meanings.
#include <array>

#include "slapstick/model/quantity.hpp"

namespace slapstick {
namespace {

using Kind = Quantity::Kind;
using Of = QuantityRule::Of;

constexpr std::array known_rules = {
    QuantityRule{Of::coordinate, Kind::displacement, "NAME",
                 "displacement of NAME; of s_PART the stretch of its damper or slider"},
    QuantityRule{Of::coordinate, Kind::velocity, "v_NAME", "velocity of NAME"},
    QuantityRule{Of::coordinate, Kind::acceleration, "a_NAME", "acceleration of NAME; impacts are impulses in it"},
    QuantityRule{Of::stop, Kind::gap, "gap_NAME", "gap of stop NAME"},
    QuantityRule{Of::stop, Kind::relative, "w_NAME", "relative velocity of stop NAME"},
    QuantityRule{Of::stop, Kind::force, "F_NAME", "press of stop NAME: 0 when open, impulses at impacts"},
    QuantityRule{Of::stop, Kind::power, "power_NAME", "power that stop NAME takes: impulses at impacts"},
    QuantityRule{Of::friction, Kind::relative, "w_NAME", "relative velocity of friction contact NAME"},
    QuantityRule{Of::friction, Kind::force, "F_NAME",
                 "force of friction contact NAME: friction in slip, the holding force in stick"},
    QuantityRule{Of::friction, Kind::normal, "N_NAME", "normal force of friction contact NAME, if not constant"},
    QuantityRule{Of::friction, Kind::power, "power_NAME", "power that friction contact NAME dissipates"},
    QuantityRule{Of::compliant_stop, Kind::gap, "gap_NAME", "gap of compliant stop NAME"},
    QuantityRule{Of::compliant_stop, Kind::relative, "w_NAME", "relative velocity of compliant stop NAME"},
    QuantityRule{Of::compliant_stop, Kind::force, "F_NAME", "press of compliant stop NAME: 0 when it does not act"},
    QuantityRule{Of::compliant_stop, Kind::power, "power_NAME", "power that compliant stop NAME dissipates"},
    QuantityRule{Of::characteristic, Kind::relative, "w_NAME",
                 "relative velocity of characteristic or Jenkins element NAME"},
    QuantityRule{Of::characteristic, Kind::force, "F_NAME", "force of characteristic or Jenkins element NAME"},
    QuantityRule{Of::characteristic, Kind::power, "power_NAME",
                 "power that characteristic or Jenkins element NAME dissipates"},
    QuantityRule{Of::spring, Kind::relative, "w_NAME", "relative velocity of spring NAME"},
    QuantityRule{Of::spring, Kind::force, "F_NAME", "force of spring or Maxwell element NAME"},
    QuantityRule{Of::spring, Kind::power, "power_NAME", "power that Maxwell element NAME dissipates"},
    QuantityRule{Of::damper, Kind::relative, "w_NAME", "relative velocity of damper NAME"},
    QuantityRule{Of::damper, Kind::force, "F_NAME", "force of damper NAME"},
    QuantityRule{Of::damper, Kind::power, "power_NAME", "power that damper NAME dissipates"},
    QuantityRule{Of::model, Kind::kinetic, "kinetic_energy", "kinetic energy of all masses"},
    QuantityRule{Of::model, Kind::potential, "potential_energy",
                 "energy in springs, compliant stops and characteristics"},
    QuantityRule{Of::model, Kind::input, "power_in", "power that forces and belts bring"},
    QuantityRule{Of::model, Kind::damping, "power_damping", "power that dampers and the damping matrix dissipate"},
    QuantityRule{Of::impacts, Kind::speed, "w", "at impacts of all stops: speed just before"},
    QuantityRule{Of::impacts, Kind::impulse, "impulse", "at impacts of all rigid stops: impulse of the stop"},
    QuantityRule{Of::impacts, Kind::loss, "energy_lost", "at impacts of all rigid stops: energy lost"},
    QuantityRule{Of::impacts, Kind::flight, "flight", "at impacts: time since the impact before, in forcing periods"},
    QuantityRule{Of::impacts, Kind::sliding, "sliding",
                 "at impacts: time of slip since the impact before, in forcing periods"},
    QuantityRule{Of::impacts_of_one, Kind::speed, "speed_NAME", "at impacts of NAME: speed just before"},
    QuantityRule{Of::impacts_of_one, Kind::impulse, "impulse_NAME", "at impacts of NAME: impulse"},
    QuantityRule{Of::impacts_of_one, Kind::loss, "energy_lost_NAME", "at impacts of NAME: energy lost"},
    QuantityRule{Of::impacts_of_one, Kind::flight, "flight_NAME",
                 "at impacts of NAME: time since the one before, in forcing periods"},
    QuantityRule{Of::impacts_of_one, Kind::sliding, "sliding_NAME",
                 "at impacts of NAME: time of slip since the one before, in forcing periods"},
};

}  // namespace

std::span<const QuantityRule> quantity_rules() { return known_rules; }

std::string_view name(QuantityRule::Of of) {
  static constexpr std::array<std::string_view, 10> words = {"coordinate",     "stop",    "friction", "compliant stop",
                                                             "characteristic", "spring",  "damper",   "model",
                                                             "all stops",      "one stop"};
  return words[static_cast<std::size_t>(of)];
}

}  // namespace slapstick

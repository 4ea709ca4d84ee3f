#pragma once
/// Equality of models, member by member and bit by bit, for tests.
#include <gtest/gtest.h>

#include <algorithm>

#include "slapstick/model/model.hpp"

namespace slapstick {

inline bool same_load(const std::optional<NormalForce>& a, const std::optional<NormalForce>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->constant == b->constant && a->compliant_stop == b->compliant_stop &&
         std::ranges::equal(a->terms, b->terms, [](const auto& p, const auto& q) {
           return p.coordinate == q.coordinate && p.stiffness == q.stiffness && p.damping == q.damping;
         });
}

inline void expect_same(const Model& a, const Model& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.omega, b.omega);
  const auto same = [](const auto& first, const auto& second, auto equal) {
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_TRUE(equal(first[i], second[i])) << i;
  };
  same(a.coordinates, b.coordinates, [](const auto& p, const auto& q) { return p.name == q.name && p.mass == q.mass; });
  same(a.springs, b.springs,
       [](const auto& p, const auto& q) { return p.a == q.a && p.b == q.b && p.stiffness == q.stiffness; });
  same(a.dampers, b.dampers,
       [](const auto& p, const auto& q) { return p.a == q.a && p.b == q.b && p.coefficient == q.coefficient; });
  same(a.forces, b.forces, [](const auto& p, const auto& q) {
    return p.coordinate == q.coordinate && p.harmonic == q.harmonic && p.amplitude == q.amplitude &&
           p.phase == q.phase && p.presses == q.presses && p.contact == q.contact;
  });
  same(a.frictions, b.frictions, [](const auto& p, const auto& q) {
    return p.name == q.name && p.a == q.a && p.b == q.b && p.belt_speed == q.belt_speed &&
           p.static_friction == q.static_friction && p.kinetic_friction == q.kinetic_friction &&
           same_load(p.normal, q.normal);
  });
  same(a.stops, b.stops, [](const auto& p, const auto& q) {
    return p.name == q.name && p.a == q.a && p.b == q.b && p.clearance == q.clearance &&
           p.restitution == q.restitution && std::ranges::equal(p.corners, q.corners, [](const auto& c, const auto& d) {
             return c.speed == d.speed && c.restitution == d.restitution;
           });
  });
  same(a.compliant_stops, b.compliant_stops, [](const auto& p, const auto& q) {
    return p.name == q.name && p.a == q.a && p.b == q.b && p.clearance == q.clearance && p.stiffness == q.stiffness &&
           p.damping == q.damping && p.pulls == q.pulls && p.bounded == q.bounded;
  });
  same(a.characteristics, b.characteristics, [](const auto& p, const auto& q) {
    return p.name == q.name && p.a == q.a && p.b == q.b && p.over == q.over && p.slope_below == q.slope_below &&
           p.slope_above == q.slope_above && std::ranges::equal(p.corners, q.corners, [](const auto& c, const auto& d) {
             return c.at == d.at && c.force == d.force;
           });
  });
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.stiffness, b.stiffness);
  EXPECT_EQ(a.impact_law, b.impact_law);
}

}  // namespace slapstick

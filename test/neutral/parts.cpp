/// Edits that add parts without an effect, or say one part in another way.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "neutral/edits.hpp"

namespace slapstick::neutral {
namespace {

/// Longer than any name of a file: of contacts that hold together the shortest name is told.
constexpr const char* never_reached = "a_contact_that_is_never_reached";
constexpr const char* never_pressed = "a_friction_contact_that_is_never_pressed";

template <class Things>
auto& any(Things& things, campaign::Random& random) {
  return things[static_cast<std::size_t>(random.below(static_cast<int>(things.size())))];
}

/// The parts of a kind that `fits`.
std::vector<Part*> those(Definition& file, const std::string& kind, const std::function<bool(const Part&)>& fits) {
  std::vector<Part*> found;
  for (Part& part : parts(file, kind))
    if (fits(part)) found.push_back(&part);
  return found;
}

/// First or last in its list.
void put(std::vector<Part>& list, const Part& part, campaign::Random& random) {
  list.insert(random.one_in(2) ? list.begin() : list.end(), part);
}

/// Between a coordinate and what it is measured from, or another coordinate that is measured from there.
Part far_contact(const Definition& file, const std::string& name, campaign::Random& random) {
  Part part;
  part.name = name;
  part.a = random.below(coordinates(file));
  part.b = random.below(coordinates(file));
  if (part.b == part.a || home(file, part.b) != home(file, part.a)) part.b = home(file, part.a);
  if (random.one_in(2)) std::swap(part.a, part.b);
  for (const char* kind : {"spring", "damper", "friction", "freewheel", "stop", "compliant_stop"})
    for (const Part& other : file.of(kind)) {  // contacts between the same ends have one ratio
      const bool linear = other.fields.contains("stiffness") || other.fields.contains("coefficient");
      if (linear && std::string_view(kind) != "compliant_stop" && other.within.empty()) continue;
      const Ratio ratio = other.ratio.value_or(Ratio{});
      if (other.a == part.a && other.b == part.b) part.ratio = ratio;
      if (other.a == part.b && other.b == part.a) part.ratio = Ratio{ratio.b, ratio.a};
    }
  if (part.ratio == Ratio{}) part.ratio.reset();
  return part;
}

Part far_spring(const Definition& file, campaign::Random& random) {
  Part part = far_contact(file, never_reached, random);
  part.fields = {{"clearance", number(random.decades(2, 6))},
                 {"stiffness", number(random.decades(0, 2))},
                 {"damping", number(0.5)}};
  return part;
}

std::optional<Edited> with_part(const Definition& file, const std::string& kind, const Part& part,
                                campaign::Random& random) {
  Edited edited{file, {}};
  if (const auto clearance = part.fields.find("clearance"); clearance != part.fields.end())
    edited.rule.farthest = clearance->second.number;
  put(parts(edited.file, kind), part, random);
  return edited;
}

}  // namespace

std::optional<Edited> parallel_springs(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  const auto plain = those(edited.file, "spring",
                           [](const Part& p) { return p.fields.contains("stiffness") && !p.texts.contains("name"); });
  if (plain.empty()) return std::nullopt;
  Part& spring = *any(plain, random);
  Part other = spring;
  const double share = random.uniform(0.2, 0.8);
  multiply(*field(spring, "stiffness"), share);
  multiply(*field(other, "stiffness"), 1.0 - share);
  put(parts(edited.file, "spring"), other, random);
  return edited;
}

std::optional<Edited> collinear_corner(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  std::vector<Part*> bent;
  for (const char* kind : {"spring", "damper", "stop"})
    for (Part* part : those(edited.file, kind, [](const Part& p) { return p.points.size() > 1; })) bent.push_back(part);
  if (bent.empty()) return std::nullopt;
  Part& part = *any(bent, random);
  const auto k = static_cast<std::size_t>(random.below(static_cast<int>(part.points.size()) - 1));
  const Point low = part.points[k], high = part.points[k + 1];
  const double middle = (low.at.number + high.at.number) / 2, force = (low.force.number + high.force.number) / 2;
  part.points.insert(part.points.begin() + static_cast<std::ptrdiff_t>(k) + 1, {number(middle), number(force)});
  if (const auto name = part.texts.find("name"); name != part.texts.end()) edited.rule.rows_apart = {name->second};
  return edited;
}

/// k (x - x_base) = k x - F with x_base = F / k.
std::optional<Edited> force_as_base(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  const auto forces = those(edited.file, "force", [](const Part& p) {
    return !p.texts.contains("signal") && p.band.empty() && p.presses.empty();
  });
  if (forces.empty()) return std::nullopt;
  Part& force = *any(forces, random);
  const auto springs = those(edited.file, "spring", [&](const Part& p) {
    const bool other_end = (p.a == force.a && p.b == ground) || (p.b == force.a && p.a == ground);
    return other_end && !p.ratio && p.fields.contains("stiffness") && !p.fields.at("stiffness").expression &&
           std::abs(p.fields.at("stiffness").number) > 0.05;
  });
  if (springs.empty()) return std::nullopt;
  Part& spring = *any(springs, random);
  Part base, harmonic;
  harmonic.fields = force.fields;
  if (!field(harmonic, "harmonic") && !field(harmonic, "frequency")) harmonic.fields["harmonic"] = number(1);
  multiply(*field(harmonic, "amplitude"), 1.0 / spring.fields.at("stiffness").number);
  base.name = "moving";
  base.harmonics = {harmonic};
  (spring.a == ground ? spring.a : spring.b) = base_end(static_cast<int>(parts(edited.file, "base").size()));
  parts(edited.file, "force")
      .erase(parts(edited.file, "force").begin() + (&force - parts(edited.file, "force").data()));
  parts(edited.file, "base").push_back(base);
  return edited;
}

/// Fixed limits as coefficients of a normal force of 1, which a constant force gives.
std::optional<Edited> pressed_by_one(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  const auto fixed = those(edited.file, "friction", [](const Part& p) {
    return p.load.empty() && p.load_stop.empty() && p.points.empty() && p.stribeck.empty();
  });
  if (fixed.empty()) return std::nullopt;
  Part& contact = *any(fixed, random);
  contact.load = {{"constant", number(0)}};
  Part press;
  press.presses = contact.name;
  press.fields = {{"amplitude", number(1)}, {"harmonic", number(0)}};
  put(parts(edited.file, "force"), press, random);
  return edited;
}

/// A contact that holds as much either way, and has as much in slip, as a freewheel of that drag.
std::optional<Edited> friction_as_freewheel(const Definition& file, campaign::Random& random) {
  Edited edited{file, {}};
  const auto even = those(edited.file, "friction", [](const Part& p) {
    const auto plain = [&](const char* key) {
      const auto found = p.fields.find(key);
      return found == p.fields.end()    ? std::optional(0.0)
             : found->second.expression ? std::nullopt
                                        : std::optional(found->second.number);
    };
    const bool one_limit = plain("static") && (!p.fields.contains("kinetic") || plain("kinetic") == plain("static"));
    return p.load.empty() && p.load_stop.empty() && p.points.empty() && p.stribeck.empty() && one_limit &&
           plain("belt_speed") == 0.0;
  });
  if (even.empty()) return std::nullopt;
  Part* contact = any(even, random);
  Part wheel = *contact;
  wheel.fields = {{"holds", *field(*contact, "static")}, {"drag", *field(*contact, "static")}};
  auto& frictions = parts(edited.file, "friction");
  frictions.erase(frictions.begin() + (contact - frictions.data()));
  put(parts(edited.file, "freewheel"), wheel, random);
  return edited;
}

std::optional<Edited> far_stop(const Definition& file, campaign::Random& random) {
  Part part = far_contact(file, never_reached, random);
  part.fields = {{"clearance", number(random.decades(2, 6))}, {"restitution", number(0.5)}};
  return with_part(file, "stop", part, random);
}

std::optional<Edited> far_compliant_stop(const Definition& file, campaign::Random& random) {
  return with_part(file, "compliant_stop", far_spring(file, random), random);
}

/// Pressed by a compliant stop that is never reached.
std::optional<Edited> far_pad(const Definition& file, campaign::Random& random) {
  auto edited = far_compliant_stop(file, random);
  Part pad = far_contact(file, never_pressed, random);
  pad.fields = {{"static", number(0.5)}, {"kinetic", number(0.4)}};
  pad.load_stop = never_reached;
  put(parts(edited->file, "friction"), pad, random);
  return edited;
}

std::optional<Edited> zero_force(const Definition& file, campaign::Random& random) {
  Part part;
  part.a = random.below(coordinates(file));
  part.fields = {{"amplitude", number(0)}, {"harmonic", number(1 + random.below(3))}};
  const auto loaded = std::ranges::find_if(file.of("friction"), [](const Part& p) { return !p.load.empty(); });
  if (loaded != file.of("friction").end() && random.one_in(2)) part.a = ground, part.presses = loaded->name;
  auto edited = with_part(file, "force", part, random);
  if (!edited->file.omega) edited->file.omega = number(random.uniform(0.5, 3));
  return edited;
}

std::optional<Edited> zero_tone(const Definition& file, campaign::Random& random) {
  Part part;
  part.a = random.below(coordinates(file));
  part.fields = {{"amplitude", number(0)}, {"frequency", number(random.uniform(0.5, 3))}};
  return with_part(file, "force", part, random);
}

std::optional<Edited> zero_signal(const Definition& file, campaign::Random& random) {
  Part part, signal;
  signal.name = "quiet";
  signal.points = {
      {number(0.3), number(0)}, {number(1.1), number(random.one_in(2) ? 0.0 : 1.0)}, {number(2.0), number(0)}};
  part.a = random.below(coordinates(file));
  const bool silent = signal.points[1].force.number == 0.0;
  part.fields = {{"amplitude", number(silent ? 1.0 : 0.0)}};
  part.texts["signal"] = "quiet";
  auto edited = with_part(file, "force", part, random);
  parts(edited->file, "signal").push_back(signal);
  edited->rule.rows_apart = {"quiet"};
  return edited;
}

std::optional<Edited> zero_impulse(const Definition& file, campaign::Random& random) {
  Part part;
  part.name = "quiet";
  part.a = random.below(coordinates(file));
  part.fields = {{"momentum", number(0)},
                 {file.omega && random.one_in(2) ? "phase" : "time", number(random.uniform(0.5, 3))}};
  return with_part(file, "impulse", part, random);
}

}  // namespace slapstick::neutral

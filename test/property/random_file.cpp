#include "property/random_file.hpp"

#include <algorithm>
#include <random>
#include <sstream>

#include "property/machine.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::test {
namespace {

Scalar number(double value) { return {value, std::nullopt, 0}; }

class FileDraw {
 public:
  FileDraw(std::uint64_t seed, const FileShape& shape) : random_(seed), shape_(shape) {}

  Definition file() {
    file_ = machine();
    if (shape_.free && one_in(4)) without_drive();
    if (forced() && one_in(3)) base();
    if (shape_.tones && one_in(8)) tone();
    if (shape_.signals && one_in(8)) signal();
    for (Part& stop : parts("stop")) two_sided(stop, 3);
    for (Part& stop : parts("compliant_stop")) two_sided(stop, 3), unloading(stop);
    for (Part& contact : parts("friction")) falling(contact);
    if (one_in(6)) zones();
    if (coordinates() > 1 && one_in(4)) gear();
    for (int k = integer(0, 2); k > 0; --k) parameter(k);
    if (shape_.signals && one_in(8)) impulse();
    if (one_in(5)) ratio();
    if (one_in(6)) press();
    if (one_in(6)) freewheel();
    if (one_in(5)) series("maxwell", "rubber", "damping");
    if (one_in(5)) series("jenkins", "joint", "limit");
    return std::move(file_);
  }

 private:
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool one_in(int n) { return integer(1, n) == 1; }
  std::vector<Part>& parts(const char* kind) { return file_.parts[kind]; }
  int coordinates() { return static_cast<int>(parts("coordinate").size()); }
  Part& any(const char* kind) {
    return parts(kind)[static_cast<std::size_t>(integer(0, static_cast<int>(parts(kind).size()) - 1))];
  }

  /// The machine's zones have coefficients that a file does not: those of a file are made by `zones`.
  Definition machine() {
    Shape shape;
    shape.most_coordinates = shape_.most_coordinates;
    shape.laws = one_in(2);
    Machine machine = random_machine(random_(), shape);
    std::erase_if(machine.model.characteristics, [](const Characteristic& c) {
      return c.over == Characteristic::Over::zones || c.corners.size() < 2;
    });
    std::ostringstream text;
    text << machine;
    return read_definition(text.str(), "random.toml");
  }

  static bool harmonic(const Part& force) {
    const auto found = force.fields.find("harmonic");
    return found != force.fields.end() && found->second.number > 0.0;
  }

  bool forced() {
    for (const Part& force : parts("force"))
      if (harmonic(force)) return true;
    return false;
  }

  void without_drive() {
    std::erase_if(parts("force"), harmonic);
    file_.omega.reset();
  }

  /// Springs or dampers stand on the base, or every coordinate is measured from it, and then contacts move with it.
  void base() {
    Part base;
    base.name = "floor";
    for (int k = integer(1, 2); k > 0; --k) {
      Part harmonic;
      harmonic.fields = {
          {"amplitude", number(real(-0.3, 0.3))}, {"harmonic", number(k)}, {"phase", number(real(0, 6))}};
      base.harmonics.push_back(harmonic);
    }
    parts("base").push_back(base);
    if (!one_in(3)) {
      Part link;
      link.a = integer(0, coordinates() - 1), link.b = base_end(0);
      const bool spring = one_in(2);
      link.fields = {{spring ? "stiffness" : "coefficient", number(real(0.1, 1))}};
      parts(spring ? "spring" : "damper").push_back(link);
      return;
    }
    carry(0);
  }

  /// Every coordinate is measured from a base.
  void carry(int base) {
    for (Part& coordinate : parts("coordinate"))
      coordinate.b = base_end(base), coordinate.texts["base"] = parts("base")[static_cast<std::size_t>(base)].name;
    for (const char* kind : {"stop", "friction", "compliant_stop", "spring", "damper"})
      for (Part& part : parts(kind))
        for (int* end : {&part.a, &part.b})
          if (*end == ground) *end = base_end(base);
  }

  static bool steps(const Part& signal) {
    const auto& points = signal.points;
    for (std::size_t i = 1; i < points.size(); ++i)
      if (points[i].at.number == points[i - 1].at.number) return true;
    return signal.flag("repeats") && points.front().force.number != points.back().force.number;
  }

  void tone() {
    Part force;
    force.a = integer(0, coordinates() - 1);
    force.fields = {
        {"amplitude", number(real(-0.5, 0.5))}, {"frequency", number(real(0.4, 3))}, {"phase", number(real(0, 6))}};
    parts("force").push_back(force);
  }

  /// A round takes a forcing period, or half of one.
  void repeat_in_periods(Part& signal) {
    signal.flags["repeats"] = signal.flags["in_periods"] = true;
    const double first = signal.points.front().at.number, length = signal.points.back().at.number - first;
    const double round = one_in(3) ? 0.5 : 1.0;
    for (Point& point : signal.points) point.at.number = 0.237 + round * ((point.at.number - first) / length);
    if (one_in(2)) signal.points.back().force = signal.points.front().force;
  }

  void signal() {
    Part signal;
    signal.name = "record";
    double time = real(0, 1);
    for (int k = integer(2, 5); k > 0; --k, time += real(0.3, 2)) {
      if (one_in(4)) signal.points.push_back({number(time), number(real(-0.5, 0.5))});  // a step
      signal.points.push_back({number(time), number(real(-0.5, 0.5))});
    }
    if (file_.omega && one_in(2)) {
      repeat_in_periods(signal);
    } else if (one_in(3)) {
      signal.flags["repeats"] = true, signal.points.back().force = signal.points.front().force;
    }
    parts("signal").push_back(signal);
    if (one_in(2)) {
      Part force;
      force.a = integer(0, coordinates() - 1);
      force.fields = {{"amplitude", number(real(-1, 1))}};
      force.texts["signal"] = "record";
      parts("force").push_back(force);
      return;
    }
    Part base, spring;
    base.name = "road", base.texts["signal"] = "record";
    parts("base").push_back(base);
    if (parts("base").size() == 1 && !steps(parts("signal").back()) && one_in(2)) return carry(0);
    spring.a = integer(0, coordinates() - 1), spring.b = base_end(static_cast<int>(parts("base").size()) - 1);
    spring.fields = {{"stiffness", number(real(0.1, 1))}};
    parts("spring").push_back(spring);
  }

  /// Once, or again and again: by the forcing's phase or a period.
  void impulse() {
    Part blow;
    blow.name = "blow";
    blow.a = integer(0, coordinates() - 1);
    blow.fields = {{"momentum", number(real(-0.5, 0.5))}};
    if (file_.omega && one_in(2)) {
      blow.fields["phase"] = number(real(0, 6));
    } else {
      blow.fields["time"] = number(real(0.1, 3));
      if (one_in(2)) blow.fields["period"] = number(real(1, 4));
    }
    parts("impulse").push_back(blow);
  }

  void two_sided(Part& stop, int share) {
    if (!one_in(share)) return;
    stop.flags["two_sided"] = true;
    stop.fields["clearance_lower"] = number(real(0.5, 2));
  }

  void unloading(Part& stop) {
    if (!one_in(5)) return;
    stop.fields.erase("damping"), stop.texts.erase("law");
    stop.fields["unloading_stiffness"] = number(stop.fields["stiffness"].number * real(0.5, 1));
  }

  void falling(Part& friction) {
    const bool loaded = !friction.load.empty() || !friction.load_stop.empty();
    if (loaded || !one_in(5)) return;
    const double force = friction.fields["static"].number;
    friction.fields.erase("kinetic");
    if (one_in(2)) {
      friction.points = {{number(0), number(force * 0.9)}, {number(0.5), number(force * 0.5)}};
      return;
    }
    friction.fields.erase("static");
    friction.stribeck = {{"static", number(force)},
                         {"kinetic", number(force * 0.6)},
                         {"speed", number(0.4)},
                         {"exponent", number(coordinates() % 2 == 0 ? 1.0 : 1.5)},
                         {"corners", number(3)}};
  }

  void zones() {
    Part damper;
    damper.a = integer(0, coordinates() - 1);
    const auto& coordinate = parts("coordinate")[static_cast<std::size_t>(damper.a)];
    damper.b = coordinate.b;  // what it is measured from
    damper.texts["name"] = "oil";
    damper.fields = {{"coefficient", number(real(0.05, 0.5))}, {"coefficient_outside", number(real(0, 0.3))}};
    damper.within = {number(real(-1, 0)), number(real(0.1, 1))};
    parts("damper").push_back(damper);
  }

  /// The potential of k (x_1 - r x_2)^2 / 2 as a matrix.
  void gear() {
    const std::size_t n = parts("coordinate").size();
    const double k = real(0.2, 2), r = real(-2, 2);
    MatrixEntry matrix;
    matrix.entries.assign(n * n, number(0));
    matrix.entries[0] = number(k), matrix.entries[1] = matrix.entries[n] = number(-r * k),
    matrix.entries[n + 1] = number(r * r * k);
    file_.matrices["stiffness"] = matrix;
  }

  /// Of a link, or of a stop and friction on one pair: both ends stand still with the ground.
  void ratio() {
    constexpr const char* kinds[] = {"stop", "compliant_stop", "friction", "spring", "damper"};
    const char* kind = kinds[integer(0, 4)];
    if (parts(kind).empty()) return;
    const Part link = any(kind);
    const auto still = [&](int end) {
      return end == ground || (end >= 0 && parts("coordinate")[static_cast<std::size_t>(end)].b == ground);
    };
    if (!still(link.a) || !still(link.b)) return;
    const Ratio of_ends{one_in(2) ? 2.0 : real(0.4, 2), one_in(2) ? 1.0 : real(-2, -0.4)};
    for (const char* other : kinds)
      for (Part& part : parts(other))
        if (part.a == link.a && part.b == link.b) part.ratio = of_ends;
  }

  /// A harmonic, a tone, the record or a constant presses a friction contact.
  void press() {
    if (parts("friction").empty()) return;
    Part& contact = any("friction");
    if (!contact.points.empty() || !contact.stribeck.empty()) return;
    if (contact.load.empty() && contact.load_stop.empty()) contact.load = {{"constant", number(real(0.3, 1.5))}};
    Part force;
    force.presses = contact.name;
    force.fields = {{"amplitude", number(real(-0.8, 0.8))}};
    if (!parts("signal").empty() && one_in(2)) {
      force.texts["signal"] = parts("signal").front().name;
    } else if (shape_.tones && one_in(4)) {
      force.fields["frequency"] = number(real(0.4, 3));
    } else {
      force.fields["harmonic"] = number(forced() ? integer(0, 2) : 0);
      force.fields["phase"] = number(real(0, 6));
    }
    parts("force").push_back(force);
  }

  /// A contact of one limit holds more in one sense than it drags in the other.
  void freewheel() {
    auto& contacts = parts("friction");
    const auto plain = std::ranges::find_if(contacts, [](const Part& p) {
      return p.points.empty() && p.stribeck.empty() && p.load.empty() && p.load_stop.empty() &&
             !p.fields.at("static").expression;
    });
    if (plain == contacts.end()) return;
    Part wheel = *plain;
    wheel.fields = {{"holds", number(real(0.3, 3))}};
    if (one_in(2)) wheel.fields["drag"] = number(real(0, 0.3));
    contacts.erase(plain);
    parts("freewheel").push_back(wheel);
  }

  /// Elements with a spring in series, between two coordinates that are measured from one place, or one and that place.
  void series(const char* kind, const std::string& name, const char* other) {
    const auto home = [&](int i) { return parts("coordinate")[static_cast<std::size_t>(i)].b; };
    for (int k = integer(1, 2); k > 0; --k) {
      Part element;
      element.name = name + std::to_string(k);
      element.a = integer(0, coordinates() - 1), element.b = integer(0, coordinates() - 1);
      if (element.a == element.b || home(element.a) != home(element.b) || one_in(2)) element.b = home(element.a);
      element.fields = {{"stiffness", number(real(0.2, 2))}, {other, number(real(0.1, 2))}};
      parts(kind).push_back(element);
    }
  }

  /// A number of a spring, force or friction contact becomes a parameter, or a multiple of one.
  void parameter(int which) {
    constexpr const char* kinds[] = {"spring", "force", "friction", "stop"};
    constexpr const char* keys[] = {"stiffness", "amplitude", "static", "clearance"};
    const int k = integer(0, 3);
    if (parts(kinds[k]).empty()) return;
    Part& part = any(kinds[k]);
    const auto found = part.fields.find(keys[k]);
    if (found == part.fields.end() || found->second.expression) return;
    ParameterEntry entry;
    entry.shown.name = "p" + std::to_string(which);
    const bool twice = one_in(2);
    entry.value = number(twice ? found->second.number / 2 : found->second.number);
    found->second = {0.0, Expression((twice ? "2 * " : "") + entry.shown.name), 0};
    file_.parameters.push_back(entry);
  }

  std::mt19937_64 random_;
  const FileShape& shape_;
  Definition file_;
};

}  // namespace

Definition random_file(std::uint64_t seed, const FileShape& shape) {
  for (std::uint64_t attempt = 0;; ++attempt) {
    try {
      const std::string text = print_definition(FileDraw(seed + (attempt << 40), shape).file(), {});
      const ModelDefinition sound = ModelDefinition::parse(text, "random.toml");
      (void)sound.build(), (void)sound.start();
      return read_definition(text, "random.toml");
    } catch (const InputError&) {  // stops without room, a start beyond one, a name twice: drawn again
    }
  }
}

}  // namespace slapstick::test

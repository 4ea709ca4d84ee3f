/// Writes the commented file of `slapstick new`.
#include "base/text.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {
namespace {

/// What is switched off has no blank after '#': take the '#' away to switch it on. test/io/new_model_test.cpp switches
/// all of it on.
constexpr std::string_view page =
    R"toml(# A model for slapstick. docs/reference/model_file.md explains every key; `slapstick check @NAME@.toml` checks this file.
# Lines like "#notes = ..." are switched off: remove the '#' to use them.
name = "@NAME@"
summary = "A mass on a spring, shaken by a force; it rubs on the ground and hits a wall"
#notes = """
#Where the numbers come from, what is special about them.
#"""

# Every number may be a number or, in quotes, an expression of the parameters below.
omega = "omega"             # forcing frequency, in rad per unit of time
#impact_law = "moreau"       # several stops hit at one instant: "moreau" (all at once) or "sequence" (one after another)

# What --set and sweeps may change. Bounds: min and max (inside), above and below (outside).
[parameters]
omega = { value = 0.9, above = 0, description = "forcing frequency; the natural frequency is 1" }
amplitude = { value = 1, description = "amplitude of the force" }
damping_ratio = { value = 0.05, min = 0, below = 10, description = "fraction of critical damping" }
static_friction = { value = 0.1, min = 0, unit = "1", description = "largest friction force in stick" }
kinetic_friction = { value = "static_friction", min = 0, description = "friction force in slip; follows until it is set" }
gap = { value = 1, min = 0, description = "distance of the wall" }
restitution = { value = 0.7, min = 0, max = 1, description = "speed after / before an impact" }

# One name that sets several parameters.
[groups]
friction = ["static_friction", "kinetic_friction"]

# A displacement. The velocity of x1 is v1.
[[coordinate]]
name = "x1"
mass = 1
#unit = "mm"                 # of its columns; see [scale]

#[[coordinate]]
#name = "x2"
#mass = 2

# Measured from a base: stops and friction contacts may then name the base, and so move.
#[[coordinate]]
#name = "x3"
#mass = 1
#base = "shaker"

# Between two coordinates, or one and "ground"; the force is stiffness * (x_a - x_b).
[[spring]]
between = ["x1", "ground"]
stiffness = 1

[[damper]]
between = ["x1", "ground"]
coefficient = "2 * damping_ratio"

# A spring and a damper in series; s_mount is the stretch of its damper.
#[[maxwell]]
#name = "mount"
#between = ["x1", "ground"]
#ratio = [1, 1]
#stiffness = 3
#damping = 2

# A spring and a slider in series, which slips at the limit of the force; s_joint is the way that it has slipped.
#[[jenkins]]
#name = "joint"
#between = ["x1", "ground"]
#ratio = [1, 1]
#stiffness = 3
#limit = 0.5

# amplitude * sin(harmonic * omega * t + phase); harmonic 0 is a constant force of size amplitude.
[[force]]
on = "x1"
amplitude = "amplitude"
harmonic = 1
phase = "pi / 2"

# On a friction contact with a normal force a force presses it: N = 2 + 0.5 sin(2 omega t).
#[[force]]
#on = "brake"
#amplitude = 0.5
#harmonic = 2
#[[friction]]
#name = "brake"
#between = ["x1", "ground"]
#static = 0.4
#normal_force = { constant = 2 }

# A force of another frequency than omega; the motion then has no period.
#[[force]]
#on = "x1"
#amplitude = 0.1
#frequency = "2 ^ 0.5"

# A force that follows a signal: points [time, value] and straight lines between them, or the columns of a file.
# Two points at one time are a step. One that repeats in forcing periods is a drive, as a harmonic is.
#[[signal]]
#name = "push"
#points = [[0, 0], [0.25, 0.5], [0.25, 0.2], [1, 0]]
#repeats = true
#in_periods = true
# file = "push.csv"          # in place of points
# column = "force"

# A named shape, of a period of its own, or without `period` of the forcing's. `phase` leads, as that of a force does.
#[[signal]]
#name = "shape"
#shape = "trapezoid"
#duty = 0.4
#rise = 0.1
#low = 0
#high = 1
#phase = 0
#period = 3

#[[force]]
#on = "x2"
#signal = "push"
#amplitude = 2

# A blow in no time: at a time, once or with a period, or in each forcing period when omega t is its phase.
#[[impulse]]
#name = "hammer"
#on = "x2"
#momentum = 0.2
#time = 1
#period = 2

#[[impulse]]
#name = "pile_driver"
#on = "x2"
#momentum = 0.1
#phase = 0.7

# A random force: harmonics 5 to 20 of omega with phases from a seed. lines: so many of them, evenly spread.
#[[force]]
#on = "x2"
#band = { from = 5, to = 20, lines = 8, rms = 0.1, seed = 1 }

# Springs and dampers may stand on a base that moves by a signal or by a band.
#[[base]]
#name = "road"
#signal = "push"

#[[spring]]
#between = ["x2", "road"]
#stiffness = 1

#[[base]]
#name = "rumble"
#band = { from = 3, to = 9, rms = 0.01 }

#[[damper]]
#between = ["x2", "rumble"]
#coefficient = 0.1

# A moving base, which springs and dampers may name, and contacts of coordinates that are measured from it.
#[[base]]
#name = "shaker"
#harmonics = [{ amplitude = 0.1, harmonic = 1, phase = 0 }, { amplitude = 0.01, harmonic = 3 }]

#[[spring]]
#between = ["x2", "shaker"]
#stiffness = 4

# A spring (damper) whose force is a polyline over x_a - x_b (v_a - v_b); a slope beyond an end makes that end a corner.
#[[spring]]
#name = "bump_stop"
#between = ["x1", "x2"]
#ratio = [1, -2.5]          # gears, levers: r_a x_a - r_b x_b in place of x_a - x_b
#characteristic = [[-0.5, 0], [0.5, 0], [1, 2]]
#slope_below = 1
#slope_above = 8

#[[damper]]
#name = "valve"
#between = ["x1", "x2"]
#ratio = [1, 1]
#characteristic = [[-1, -0.5], [0, 0], [1, 0.2]]
#slope_below = 0.1
#slope_above = 0.05

# A damper that acts in an interval of x_a - x_b; feeds admits a coefficient below 0.
#[[damper]]
#name = "magnet"
#between = ["x1", "ground"]
#coefficient = -0.01
#feeds = true
#within = [-0.2, 0.2]
#coefficient_outside = 0.02

# Friction that depends on the speed, and is constant beyond the last one.
#[[friction]]
#name = "falling"
#between = ["x1", "x2"]
#ratio = [1, 1]
#static = 0.2
#characteristic = [[0, 0.2], [0.5, 0.1], [1, 0.12]]

# The same with a law that falls as exp(-|w| / speed), laid as a polyline of so many corners.
#[[friction]]
#name = "lubricated"
#between = ["x1", "x2"]
#stribeck = { static = 0.2, kinetic = 0.1, speed = 0.3, exponent = 2, corners = 12 }

# Friction with a normal force: static and kinetic are coefficients. N = constant + stiffness x + damping v + a stop's force.
#[[friction]]
#name = "pressed"
#between = ["x1", "x2"]
#static = 0.4
#kinetic = 0.3
#normal_force = { constant = 2, x2 = -0.5, v2 = -0.1, compliant_stop = "bumper_upper" }

# Coulomb friction. kinetic is static if it is absent.
[[friction]]
name = "ground_friction"
between = ["x1", "ground"]
static = "static_friction"
kinetic = "kinetic_friction"
belt_speed = 0

# A one-way clutch: x1 may run ahead of x2, with the force `drag`, and is held back up to `holds`.
#[[freewheel]]
#name = "sprags"
#between = ["x1", "x2"]
#ratio = [1, 1]
#holds = 50
#drag = 0.01

# A rigid stop: x_a - x_b <= clearance. A floor below x1 would be between = ["ground", "x1"].
[[stop]]
name = "wall"
between = ["x1", "ground"]
clearance = "gap"
restitution = "restitution"
#two_sided = true            # a wall on both sides, in tables as wall_upper and wall_lower,
#clearance_lower = 2         # at this distance; clearance if absent

# A stop whose restitution depends on the speed of the impact.
#[[stop]]
#name = "post"
#between = ["x1", "x2"]
#ratio = [1, 1]
#clearance = 3
#restitution_over_speed = [[0.1, 0.9], [2, 0.6]]

# A spring and damper that act beyond a gap. Unless it pulls, it lets go where its force would become negative.
#[[compliant_stop]]
#name = "bumper"
#between = ["x1", "x2"]
#ratio = [1, 1]
#clearance = 0.5
#stiffness = 100
#damping = 1
#pulls = false
#two_sided = true
#clearance_lower = 0.5

# law: "lets_go", "pulls", or "bounded": the damping force is no larger than the spring force.
#[[compliant_stop]]
#name = "rubber"
#between = ["x2", "ground"]
#clearance = 1
#stiffness = 50
#damping = 2
#law = "bounded"

# Another stiffness on the way back.
#[[compliant_stop]]
#name = "cork"
#between = ["ground", "x2"]
#clearance = 1
#stiffness = 50
#unloading_stiffness = 20

# A quantity of the state, as a column of `simulate --trajectory`: parameters, the state, gap_NAME of stops, time.
[[observable]]
name = "energy"
value = "(x1^2 + v1^2) / 2"
unit = "J"
description = "kinetic and elastic energy"

# Added to what the parts above give; n x n for n coordinates, symmetric. In place of the rows a file of this folder may stand,
# "K.mtx", "K.csv" or { file = "K.mtx", factor = 0.5 }. coordinates: what the rows stand for, names or a file of names.
#[matrix]
#coordinates = ["x1", "x2"]
#mass = [[0, 0.1], [0.1, 0]]
#damping = [[0, 0], [0, 0.2]]
#stiffness = [[0, "-amplitude"], ["-amplitude", 0]]

# What 1 is, for `simulate --physical`: physical = dimensionless * scale. A parameter with such a unit holds a physical number,
# which expressions divide by what 1 is: "speed / (scale_length / scale_time)".
#[scale]
#length = { value = 5, unit = "mm" }
#time = { value = 0.01, unit = "s" }
#mass = { value = 0.2, unit = "kg" }

# The initial state; 0 where nothing is said.
[start]
x1 = -0.5
v1 = 0
)toml";

}  // namespace

std::string new_model(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  bool plain = !name.empty() && name.size() <= 64;
  for (const char c : name) plain = plain && fits(c);
  if (!plain) throw InputError("name " + in_quotes(name) + " is not 1 to 64 letters, digits, '_' and '-'");
  std::string text(page);
  const std::string mark = "@NAME@";
  for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + name.size()))
    text.replace(at, mark.size(), name);
  return text;
}

}  // namespace slapstick

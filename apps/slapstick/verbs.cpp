/// Lists the verbs of the program.
#include "verb.hpp"

namespace slapstick::app {

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> all = {
      {"models", "list the built-in models", add_models},
      {"new", "write a commented model file to start from", add_new},
      {"show", "print a model as TOML: its parameters, equations and start", add_show},
      {"check", "read and check a model file", add_check},
      {"modes", "natural frequencies, damping and shapes, with contacts stuck or closed", add_modes},
      {"simulate", "one exact trajectory: events, samples, a picture", add_simulate},
      {"classify", "what the motion is after its transient: n-p-I, n-p-II, quasi-periodic, chaotic", add_classify},
      {"lyapunov", "all Lyapunov exponents, through impacts, stick and chatter", add_lyapunov},
      {"orbit", "a periodic orbit by Newton's method, stable or not: class, multipliers, impacts, energy", add_orbit},
      {"continue", "a branch of periodic orbits in one parameter, with its bifurcations by name", add_continue},
      {"curve", "the locus of a bifurcation of `continue` in two parameters", add_curve},
      {"poincare", "points of a section: at every impact, or once per forcing period", add_poincare},
      {"diagram", "bifurcation diagram over a parameter, on all cores", add_diagram},
      {"map", "two-parameter chart: class, attractor, exponent and quantities at every pixel", add_map},
      {"basins", "basins of attraction: the attractor that each start of a plane comes to, and shares", add_basins},
      {"quantities", "what can be measured on a model: names, units, meanings", add_quantities},
      {"measure", "statistics of forces, accelerations, energies and impacts, exact", add_measure},
      {"spectrum", "Fourier lines of a cycle, or the power density of a motion, impulses included", add_spectrum},
      {"store", "what is in the store of a long run; join stores; write tables and pictures of them", add_store},
      {"reproduce", "every figure and claim of the paper, into a folder", add_reproduce},
      {"describe", "all verbs and options, quantities and statistics: as JSON, or as the page of the documents",
       add_describe},
      {"completion", "the script by which a shell completes verbs, options, models and names", add_completion},
#ifdef SLAPSTICK_HTTP
      {"explore", "the explorer in the browser, served to this machine", add_explore},
#endif
  };
  return all;
}

}  // namespace slapstick::app

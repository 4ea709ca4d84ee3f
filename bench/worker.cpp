/// A worker of bench/ratios.py: reads a run a line (its kind and its numbers), and answers each with one line of
/// `key=value`.
#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>

#include "peers.hpp"
#include "runs.hpp"

namespace slapstick::bench {
namespace {

/// OMEGA PERIODS REPEATS.
Answer run_peer(PeerRun (*peer)(double, int, double), double tolerance, const Words& words) {
  const int repeats = std::stoi(words.at(3));
  PeerRun run;
  const double begun = cpu_time();
  for (int k = 0; k < repeats; ++k) run = peer(std::stod(words.at(1)), std::stoi(words.at(2)), tolerance);
  return {{"cpu", (cpu_time() - begun) / repeats},
          {"impacts", static_cast<double>(run.impact_times.size())},
          {"evaluations", static_cast<double>(run.evaluations)},
          {"steps", static_cast<double>(run.steps)}};
}

/// Another engine of ours is a row here, and one in `CONTENDERS` of ratios.py.
const std::map<std::string, Answer (*)(const Words&)> kinds = {
    {"slapstick", run_slapstick},
    {"system", run_system},
    {"chain", run_chain},
    {"threads", run_threads},
    {"lanes", run_lanes},
    {"chart", run_chart},
    {"odeint", [](const Words& words) { return run_peer(run_odeint, 1e-12, words); }},
    {"cvode", [](const Words& words) { return run_peer(run_cvode, 1e-9, words); }}};

void reply(const std::string& line) {
  std::istringstream in(line);
  Words words;
  for (std::string word; in >> word;) words.push_back(word);
  for (const auto& [key, value] : kinds.at(words.at(0))(words)) std::printf("%s=%.17g ", key.c_str(), value);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace slapstick::bench

int main() {
  try {
    for (std::string line; std::getline(std::cin, line);) slapstick::bench::reply(line);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench worker: %s\n", error.what());
    return 1;
  }
  return 0;
}

#include "slapstick/sweep/diagram.hpp"
#include <cstdio>
#include "slapstick/io/model_file.hpp"

int main() {
  const slapstick::ModelDefinition definition = slapstick::load_model("vibro-impact");
  slapstick::sweep::DiagramProblem problem;
  problem.model_at = [&](double omega) { return definition.build({{"omega", omega}}); };
  problem.start_at = [&](double omega) { return definition.start({{"omega", omega}}); };
  problem.from = 2.6;
  problem.to = 3.1;
  problem.count = 6;
  problem.impacts = 4;
  const slapstick::sweep::Diagram diagram = run_diagram(problem);  // on all cores, with the same bits on any number
  for (const slapstick::sweep::DiagramPoint& point : diagram.points) {
    std::printf("omega = %.1f:", point.parameter);
    for (std::size_t i = 0; i < point.impacts.size(); ++i) std::printf(" %.5f", point.impacts[i].w);
    std::printf("\n");
  }
}

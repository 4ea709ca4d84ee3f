/// Runs the study: figures, claims, page.
#include "reproduce/reproduce.hpp"

#include "io/atomic_file.hpp"
#include "reproduce/branches.hpp"
#include "reproduce/claims.hpp"
#include "reproduce/figures.hpp"
#include "reproduce/report.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::paper {
namespace {

/// With the seconds that each takes on two cores.
std::vector<PlannedPart> plan() {
  return {{"Fig. 2", 12},
          {"Figs. 3-5", 1},
          {"Fig. 6", 11},
          {"Fig. 7", 1.5},
          {"Fig. 8", 16},
          {"r = 0.08 and f_k < f_s", 10},
          {"branches of n-1", 3},
          {"doubled branches", 3},
          {"bounds over friction", 2},
          {"attractors beneath", 5},
          {"attractors over omega", 35},
          {"windows", 12},
          {"claims", 20}};
}

void prepare(const std::filesystem::path& folder) {
  figure::demand_gnuplot();  // this and the rest are known before minutes are spent
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder))
    throw StorageError("cannot make folder '" + folder.string() +
                       "': " + (error ? error.message() : "a file of that name is in the way"));
  for (const char* name : {"claims.json", "index.html"}) const AtomicFile writable(folder / name);
}

std::vector<Claim> run(Study& study) {
  for (void (*figure)(Study&) : {fig2, fig3_to_5, fig6, fig7, fig8, fig_printed}) {
    study.course().next();
    figure(study);
    study.draw();  // at once: a run that is stopped leaves the pictures it came to
  }
  study.course().next();
  const Branches branches = make_branches(study);  // begins two more parts
  study.course().next();
  fig_branches(study, branches);
  fig_bounds(study, branches);
  study.draw();
  study.course().next();
  std::vector<Claim> claims = check_claims(study);  // begins two more parts
  claims.push_back(claim_branches(study, branches));
  claims.push_back(claim_bounds(study, branches));
  study.course().finish();
  return claims;
}

}  // namespace

Reproduction reproduce(const Options& options) {
  if (options.threads < 0) throw InputError("threads = " + std::to_string(options.threads) + " is negative");
  prepare(options.folder);
  Course course(options, plan());
  Study study(options, course);
  Reproduction result;
  try {
    result.claims = run(study);
    write_atomically(study.file("claims.json"), claims_json(options, result.claims));
    write_atomically(study.file("index.html"), index_html(options, result.claims, course.parts()));
  } catch (const Interrupted&) {
    result.complete = false;
  }
  result.parts = course.parts();
  for (const auto& file : study.files())
    if (std::filesystem::exists(file)) result.files.push_back(file);
  return result;
}

}  // namespace slapstick::paper

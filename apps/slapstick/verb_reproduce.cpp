/// slapstick reproduce
#include <unistd.h>

#include <cstdio>

#include "reproduce/reproduce.hpp"
#include "verb.hpp"

namespace slapstick::app {
namespace {

struct Options {
  std::string out = "out";
  long long threads = 0;
  bool quick = false;
};

/// One line per finished part; on a terminal also one that is rewritten.
class Display {
 public:
  void progress(const paper::Progress& now) {
    if (!terminal_ || now.elapsed_s < next_) return;
    next_ = now.elapsed_s + 0.2;
    const auto left = static_cast<long>(now.left_s);
    std::fprintf(stderr, "\r\033[K%s (%.0f %% of all, %ld:%02ld left)", now.part.c_str(), 100.0 * now.fraction,
                 left / 60, left % 60);
    std::fflush(stderr);
  }
  void finished(const paper::Part& part) const {
    std::fprintf(stderr, "%s%-28s %6.1f s\n", terminal_ ? "\r\033[K" : "", part.name.c_str(), part.seconds);
  }
  void clear() const {
    if (terminal_) std::fputs("\r\033[K", stderr);
  }

 private:
  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  double next_ = 0.0;
};

int reproduce(const Options& options, const Context& context) {
  paper::Options study;
  study.folder = options.out;
  study.threads = static_cast<int>(options.threads);
  study.quick = options.quick;
  study.cancel = &context.stop;
  study.command = "slapstick reproduce --out " + options.out + (options.quick ? " --quick" : "");
  Display display;
  study.progress = [&](const paper::Progress& now) { display.progress(now); };
  study.part_finished = [&](const paper::Part& part) { display.finished(part); };
  const paper::Reproduction result = paper::reproduce(study);
  display.clear();
  if (!result.complete) {
    std::fprintf(stderr, "interrupted; the %zu files written so far in %s are whole\n", result.files.size(),
                 options.out.c_str());
    return interrupted;
  }
  for (const paper::Claim& claim : result.claims)
    std::fprintf(stderr, "%-10s %-11s %s\n", claim.id.c_str(), std::string(name(claim.agreement)).c_str(),
                 claim.computed.c_str());
  std::fprintf(stderr, "open %s/index.html\n", options.out.c_str());
  return done;
}

}  // namespace

Action add_reproduce(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  arguments.text("--out", options->out, "DIR", "folder for the page, the figures and their data (out)");
  arguments.count("--threads", options->threads, 0, 1024, "0: all cores; the result is the same for any number (0)");
  arguments.flag("--quick", options->quick, "the same on coarse grids, in seconds: a trial, not for print");
  arguments.footer(
      "Writes index.html, claims.json and figures 2 to 8 of the paper. About two minutes on two cores. Beyond the "
      "paper: the branches of its orbits and the bounds of its windows.");
  return [options](const Context& context) { return reproduce(*options, context); };
}

}  // namespace slapstick::app

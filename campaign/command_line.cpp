/// slapstick-campaign NAME [--count N] [--seed S] [--threads T] [--out FILE]
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "base/nearest.hpp"
#include "campaign.hpp"
#include "io/atomic_file.hpp"
#include "slapstick/base/error.hpp"

namespace campaign {
namespace {

using slapstick::InputError;
using slapstick::Json;

constexpr int interrupted = 130;
std::atomic<bool> stop_requested{false};

/// The first signal asks for a clean end, the second ends the program.
extern "C" void on_signal(int signal) {
  if (stop_requested.exchange(true)) ::_exit(128 + signal);
}

std::string overview() {
  std::string text = "Campaigns (docs/developers/campaigns.md); NAME --help says more:\n\n";
  for (const Campaign& c : campaigns()) {
    char line[200];
    std::snprintf(line, sizeof line, "  %-10s %s (%g %s)\n", c.name, c.summary, static_cast<double>(c.count), c.unit);
    text += line;
  }
  return text;
}

const Campaign& find_campaign(const std::string& name) {
  std::vector<std::string> names;
  for (const Campaign& c : campaigns()) {
    if (name == c.name) return c;
    names.emplace_back(c.name);
  }
  throw InputError("no campaign " + slapstick::in_quotes(name) + slapstick::suggestion(name, names));
}

long whole(const char* what, double value, double most) {
  if (value >= 1.0 && value <= most && value == std::floor(value)) return static_cast<long>(value);
  throw InputError(std::string(what) + " = " + slapstick::shown(value) + " is no whole number from 1 to " +
                   slapstick::shown(most));
}

int run(const Campaign& campaign, const Options& options, const std::string& out) {
  const auto begin = std::chrono::steady_clock::now();
  const Report report = campaign.run(options);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Json json = Json::object();
  json.set("campaign", campaign.name).set("unit", campaign.unit).set("asked", options.count).set("done", report.done);
  json.set("seed", static_cast<std::int64_t>(options.seed)).set("threads", options.threads).set("seconds", seconds);
  json.set("passed", report.passed).set("figures", report.figures);
  if (out.empty())
    std::puts(json.dump().c_str());
  else
    slapstick::write_atomically(out, json.dump() + "\n");
  if (options.stopped()) return interrupted;
  return report.passed ? 0 : 1;
}

int parse_and_run(int count, char** arguments) {
  const std::string name = count > 1 ? arguments[1] : "--help";
  if (name == "--help" || name == "-h") return std::fputs(overview().c_str(), stdout), 0;
  const Campaign& campaign = find_campaign(name);
  CLI::App app(campaign.summary, "slapstick-campaign " + name);
  double wanted = static_cast<double>(campaign.count), seed = 1, threads = 1;
  std::string out;
  bool quiet = false;
  app.add_option("--count", wanted, std::string("how many ") + campaign.unit)->capture_default_str();
  app.add_option("--seed", seed, "of the random numbers")->capture_default_str();
  app.add_option("--threads", threads, "does not change the figures")->capture_default_str();
  app.add_option("--out", out, "file for the report; without it standard output");
  app.add_flag("--quiet", quiet, "no progress on standard error");
  try {
    app.parse(count - 1, arguments + 1);
  } catch (const CLI::CallForHelp&) {
    return std::fputs(app.help().c_str(), stdout), 0;
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what());
  }
  Options options;
  options.count = whole("--count", wanted, 1e15);
  options.seed = static_cast<std::uint64_t>(whole("--seed", seed, 9e15));
  options.threads = static_cast<int>(whole("--threads", threads, 1024));
  options.progress = !quiet;
  options.stop = &stop_requested;
  return run(campaign, options, out);
}

}  // namespace

int campaign_main(int count, char** arguments) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  int status = 3;
  try {
    return parse_and_run(count, arguments);
  } catch (const InputError& error) {
    std::fprintf(stderr, "slapstick-campaign: %s\n", error.what());
    status = 2;
  } catch (const slapstick::StorageError& error) {
    std::fprintf(stderr, "slapstick-campaign: %s\n", error.what());
    status = 4;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "slapstick-campaign: %s\n", error.what());
  }
  return status;
}

}  // namespace campaign

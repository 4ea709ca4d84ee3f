/// slapstick spectrum MODEL
#include <cmath>

#include "base/text.hpp"
#include "order_map_run.hpp"
#include "output.hpp"
#include "slapstick/base/error.hpp"
#include "span_options.hpp"
#include "spectrum_figure.hpp"

namespace slapstick::app {
namespace {

struct Options {
  SpanOptions span;
  double highest_order = 20.0, highest = 0.0, stretch = 64.0, reference = 1.0;
  std::string octaves = "none", scale = "db", plot, plot_size;
  RunUpRange climb;
  long long settle = 0;
  bool weighted = false;
};

/// Seconds in the model's unit of time, as far as the file says; else 1.
double unit_of_time(const ChosenModel& chosen) {
  const std::string unit = chosen.definition.stated_units().time;
  if (unit == "ms") return 1e-3;
  if (unit == "us") return 1e-6;
  if (unit == "min") return 60.0;
  return unit == "h" ? 3600.0 : 1.0;
}

Json bands_json(const std::vector<Band>& bands, const Options& options) {
  Json list = Json::list();
  for (const Band& band : bands) {
    Json one = Json::object();
    one.set("centre", band.centre).set("from", band.from).set("to", band.to).set("rms", std::sqrt(band.mean_square));
    one.set("level", level(band, options.reference, options.weighted)).set("whole", band.whole);
    list.push(std::move(one));
  }
  return list;
}

/// The level of all bands together: what lies below the highest frequency of the spectrum.
double total_level(const std::vector<Band>& bands, const Options& options) {
  double sum = 0.0;
  for (const Band& band : bands) sum += std::pow(10.0, 0.1 * level(band, options.reference, options.weighted));
  return 10.0 * std::log10(sum);
}

/// --to as an order: of a cycle without forcing in multiples of its own frequency.
double highest_order(const Options& options, const ChosenModel& chosen, const Span& span) {
  if (options.highest == 0.0) return options.highest_order;
  const bool own = span.cycle && !chosen.model.forced();
  return options.highest * unit_of_time(chosen) * (own ? span.cycle->cycle : chosen.model.forcing_period());
}

Json lines_json(const LineSpectrum& found) {
  Json list = Json::list();
  for (const SpectralLine& line : found.lines) {
    Json one = Json::object();
    one.set("order", line.order)
        .set("frequency", line.frequency)
        .set("amplitude", line.amplitude())
        .set("phase", line.phase());
    list.push(std::move(one));
  }
  Json json = Json::object();
  json.set("kind", "lines").set("impulses", found.impulses).set("mean_square", found.mean_square);
  return json.set("mean_square_of_lines", found.mean_square_of_lines).set("lines", std::move(list));
}

Json density_json(const DensitySpectrum& found, double stretch) {
  Json list = Json::list();
  for (std::size_t k = 0; k < found.density.size(); ++k) {
    Json one = Json::object();
    one.set("order", found.order[k]).set("frequency", found.frequency[k]).set("density", found.density[k]);
    list.push(std::move(one));
  }
  Json json = Json::object();
  json.set("kind", "density")
      .set("stretch", stretch)
      .set("stretches", found.stretches)
      .set("resolution", found.resolution);
  json.set("degrees_of_freedom", found.degrees_of_freedom).set("confidence", Json::list({found.low, found.high}));
  return json.set("points", std::move(list));
}

/// The spectrum of a cycle or of a motion, and its bands where they are asked for.
struct Found {
  Json json;
  figure::Figure figure;
  bool complete = true, any = true;  ///< any: of an interrupted density, a stretch at least
};

Found analyse(const Options& options, const ChosenModel& chosen, const Span& span, const Quantity& of,
              const Context& context, Progress& progress) {
  const SpectrumLabels labels{of.name, of.unit, options.scale == "db", options.reference, chosen.model.forced()};
  const int parts = options.octaves == "none" ? 0 : options.octaves == "1" ? 1 : 3;
  const double highest = highest_order(options, chosen, span);
  Found found;
  std::vector<Band> bands;
  if (span.cycle) {
    const LineSpectrum lines = spectrum(*span.problem, span.cycle->orbit, of, highest);
    if (parts > 0) bands = octaves(lines, parts, unit_of_time(chosen));
    found.json = lines_json(lines);
    found.figure = lines_figure(lines, labels);
  } else {
    const DensitySpectrum density = slapstick::density(
        span, of, {options.stretch, 1, highest, &context.stop, [&](double now) { progress.update(now); }});
    if (parts > 0) bands = octaves(density, parts, unit_of_time(chosen));
    found.complete = density.complete;
    found.any = density.stretches > 0;
    found.json = density_json(density, options.stretch);
    found.figure = density_figure(density, labels);
  }
  if (parts > 0) {
    found.json.set("bands", bands_json(bands, options)).set("total_level", total_level(bands, options));
    found.figure = bands_figure(bands, labels, options.weighted);
  }
  return found;
}

int run(const Options& options, const Context& context) {
  options.span.check();
  FileRoles roles;
  roles.add("MODEL", options.span.model.source);
  roles.add("--out", options.span.out);
  roles.add_plot(options.plot);
  const ChosenModel chosen = options.span.model.load();
  const std::vector<Wanted> wanted =
      parse_wanted("--of", options.span.of, quantities(chosen.definition, chosen.overrides));
  if (wanted.size() != 1 || !wanted[0].statistic.empty()) throw InputError("--of: a spectrum is of one quantity");
  const Quantity& of = wanted[0].quantity;
  if (of.at_impacts())
    throw InputError("--of: " + in_quotes(of.name) + " is a quantity at impacts: no function of time");
  if (!options.climb.sweep.empty()) {
    const SpectrumLabels labels{of.name, of.unit, options.scale == "db", options.reference, chosen.model.forced()};
    return order_map_run({options.climb, options.settle, options.highest_order, options.span.out, options.plot,
                          options.plot_size, options.span.progress},
                         chosen, options.span.model.start(chosen), of, labels, context);
  }
  Output out(options.span.out);
  const Plot plot(options.plot, options.plot_size);
  Progress progress("periods", options.span.whole(chosen, 2048), options.span.progress);
  const auto span = options.span.span(chosen, 2048, context, &progress);
  if (!span) return interrupted;
  const Found found = analyse(options, chosen, *span, of, context, progress);
  if (!found.any) return interrupted;
  Json json = Json::object(), parameters = Json::object();
  for (const auto& [name, value] : chosen.definition.values(chosen.overrides)) parameters.set(name, value);
  json.set("model", chosen.model.name).set("parameters", std::move(parameters)).set("of", of.name).set("unit", of.unit);
  json.set("over", span_json(*span)).set("complete", found.complete);
  for (const auto& [key, value] : std::get<Json::Object>(found.json.value())) json.set(key, value);
  out.write(json.dump() + "\n");
  out.commit();
  return plot.write_or_say(found.figure, found.figure.panels[0].lines.empty(), found.complete ? done : interrupted);
}

}  // namespace

Action add_spectrum(Arguments& arguments) {
  auto options = std::make_shared<Options>();
  options->span.declare(arguments);
  arguments.text("--of", options->span.of, "Q", "the quantity ('slapstick quantities MODEL' lists them)").required();
  arguments.number("--orders", options->highest_order, "N", "highest order, in multiples of the forcing (20)", positive)
      .without({"--to"});
  arguments.number("--to", options->highest, "HZ",
                   "the same as a frequency, in Hz (where the file states no unit of time, cycles per unit of time)",
                   not_negative);
  arguments.number("--stretch", options->stretch, "P", "of a density: forcing periods in a stretch (64)", positive);
  arguments.choice("--octaves", options->octaves, {"none", "1", "3"},
                   "mean squares in bands of an octave or a third of it");
  arguments.flag("--a-weighting", options->weighted, "weight the levels by A (IEC 61672)")
      .with({"--octaves 1", "--octaves 3"});
  arguments.choice("--scale", options->scale, {"db", "linear"}, "of the picture (db)");
  arguments.number("--reference", options->reference, "R", "0 dB, in the quantity's unit (1)", positive);
  options->climb.declare(arguments, {"--periods", "--time", "--transient", "--orbit", "--stable", "--unstable",
                                     "--symmetric", "--nearest", "--stretch", "--octaves", "--a-weighting", "--to"});
  arguments
      .count("--settle", options->settle, 0, 1'000'000'000,
             "of a run-up: periods at each value that are not measured (0)")
      .with({"--sweep"});
  arguments.text("--plot", options->plot, "F.png", "picture: .png, .pdf or .svg; its data and script lie beside it");
  declare_plot_size(arguments, options->plot_size);
  arguments.footer(
      "Fourier lines of the cycle that the motion settles on, as exact integrals, impulses of impacts included.\n"
      "With --periods, or where there is no cycle (then 2048 of them): a power density, by Welch's method.\n"
      "With --sweep: the lines at each value of a run-up, as a table of order, frequency and amplitude, and a "
      "waterfall.\n"
      "  slapstick spectrum vibro-impact --set omega=2.9 --of a1 --plot a1.png\n"
      "  slapstick spectrum vibro-impact --sweep omega=2:4 --over 800 --hold 20 --of a1 --out map.csv --plot map.png");
  return [options](const Context& context) { return run(*options, context); };
}

}  // namespace slapstick::app

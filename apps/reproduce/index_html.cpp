/// Writes the page that shows figures and claims beside the paper's words.
#include <cstdio>
#include <fstream>
#include <iterator>

#include "base/text.hpp"
#include "reproduce/report.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::paper {
namespace {

/// A figure of the page: the paper's words, and what is to be seen.
struct Shown {
  const char* stem;
  const char* title;
  const char* quote;  ///< from the paper; empty: the paper has no such figure
  const char* text;
};

constexpr Shown figures[] = {
    {"fig2", "Fig. 2. Bifurcation diagrams (f_s = 0.15)",
     "large windows of periodic n-1 motion were observed for ω ∈ [0.56, 10], with narrow areas of chaotic motion "
     "between two adjacent n-1 motions",
     "Flight time between impacts and relative velocity just before the impact. Grey: the edges 0.55, 1.12, 2.84 and "
     "the window [1.47, 1.60] that the "
     "paper prints. Blue: ω going up; orange: down; where both find the same they mix to black. Blue without orange, "
     "or the "
     "reverse, is a coexisting attractor."},
    {"fig2-sliding", "Fig. 2, the other reading of t_f",
     "t_f denotes the time of sliding motion of two masses between successive impacts",
     "(a) the time between impacts, which makes the staircase; (b) the part of it in which the blocks slide; (c) the "
     "rest, in which they stick."},
    {"fig3", "Fig. 3. Relative motion at ω = 1.5",
     "only in the forcing frequency range interval ω ∈ [1.47, 1.6], slip-stick motions were observed",
     "1-1-II: one impact and one short stick phase per period, magnified in (d) to (f). Dashed: the jump from w to -r "
     "w at the impact. The paper's caption says 1-1-I."},
    {"fig4", "Fig. 4. Relative motion at ω = 2.2 and 2", "A Phase portrait of 1-1-I motion is shown for ω = 2.2",
     "(a) to (c): 2.2 as in the text; (d) to (f): 2 as in the caption. Both are 1-1-I."},
    {"fig5", "Fig. 5. Chatter at ω = 0.552",
     "the timings between consecutive impacts became shorter until leading to stick model, and the relative velocities "
     "of two mass also became smaller until reaching zero",
     "(d), (e): the end of the burst; (f): the impact speeds of one burst fall faster and faster. The rest of the "
     "infinitely many impacts is summed to its proven limit."},
    {"fig6", "Fig. 6. Routes of n-1-I motions to chaos",
     "The transition from 1-1-I motion into chaos via double periodic bifurcation can be seen in Fig. (6a) … 3-1-I "
     "motion changed into 6-2-I motion via pitchfork bifurcation, and 6-2-I motion led into Hopf bifurcation",
     "(a) period doublings; (b) one doubling, a Neimark-Sacker bifurcation, a locked window, chaos; (c) the same on "
     "the next stair. The fork in (c) is a period doubling."},
    {"fig7", "Fig. 7. Poincaré section at ω = 4.801 and 4.805",
     "The quasi-periodic impact motion is represented by two attracting invariant circles in the projection of "
     "Poincare map",
     "(a) the two fixed points of 4-2-I; (b) the two closed invariant curves; (c), (d) each of them."},
    {"fig8", "Fig. 8. Bifurcation diagram for different dry friction",
     "the influence of the dry friction is not obvious in the lower excitation frequencies, only the velocity of "
     "impact becomes smaller with increased friction. But in higher frequencies, less periodic motions take place",
     "f_s = f_k = 0, 0.05, 0.1, 0.15, 0.2, 0.3; the paper does not print its values."},
    {"branches", "Branches of n-1 orbits", "",
     "Grey: attractors. Lines: the branches of 1-1 to 5-1 orbits, stable solid, unstable dashed. Above: what happens, "
     "by name; the numbers are in the "
     "table of claims. A window of n-1 motion begins where the orbit grazes the stop (GR) and ends where it doubles "
     "(PD) or gives way to a torus (NS)."},
    {"bounds", "The windows of 1-1 and 2-1 motion over friction", "",
     "GR: the next impact appears; PD: the orbit doubles. Each curve is one bifurcation, continued in both "
     "parameters."},
    {"print", "The printed parameters", "",
     "The diagram of Fig. 2 with the values used here (a), with the printed R = 0.08 (b), and with f_k = 0.1 below f_s "
     "= 0.15 (c). Grey: what the paper prints."},
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(bytes.size() * 4 / 3 + 4);
  const auto byte = [&](std::size_t i) { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U; };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned word = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    out += digits[word >> 18];
    out += digits[word >> 12 & 63];
    out += i + 1 < bytes.size() ? digits[word >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? digits[word & 63] : '=';
  }
  return out;
}

std::string picture(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (bytes.empty()) throw StorageError("cannot read " + in_quotes(file.string()));
  return "data:image/png;base64," + base64(bytes);
}

constexpr const char* head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>The stick-slip vibro-impact paper, computed</title>
<style>
body { font: 16px/1.5 "DejaVu Sans", Arial, sans-serif; color: #111; max-width: 62em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.2em; margin-top: 2.5em; }
img { max-width: 100%; } blockquote { margin: 0.5em 0; padding-left: 1em; border-left: 3px solid #bbb; color: #333; font-style: italic; }
table { border-collapse: collapse; font-size: 0.9em; } td, th { border: 1px solid #bbb; padding: 0.3em 0.6em; text-align: left; vertical-align: top; }
th { background: #f0f0f0; } .yes { background: #d9efd9; } .partly { background: #fdf0c8; } .no { background: #f6d5cc; }
code { background: #f0f0f0; padding: 0 0.2em; } details { margin: 0.3em 0; }
</style></head><body>
)";

std::string figure_section(const Options& options, const Shown& shown) {
  const std::string stem = shown.stem;
  std::string out = "<h2 id=\"" + stem + "\">" + escaped(shown.title) + "</h2>\n";
  if (*shown.quote != '\0') out += "<blockquote>“" + escaped(shown.quote) + "”</blockquote>\n";
  out += "<p>" + escaped(shown.text) + "</p>\n<p><img alt=\"" + escaped(shown.title) + "\" src=\"" +
         picture(options.folder / (stem + ".png")) + "\"></p>\n";
  return out + "<p>Files: <a href=\"" + stem + ".pdf\">PDF</a>, <a href=\"" + stem +
         ".gp\">gnuplot script</a>; data: " + stem + "*.csv</p>\n";
}

std::string quantity_table(const Claim& claim) {
  std::string out = "<details id=\"claim-" + claim.id + "\"><summary>" + claim.id + ": " +
                    std::to_string(claim.quantities.size()) +
                    " numbers</summary><table><tr><th>quantity<th>printed<th>computed<th>note</tr>\n";
  for (const Quantity& one : claim.quantities)
    out += "<tr><td>" + escaped(one.name) + "<td>" + escaped(one.printed) + "<td>" + escaped(one.computed) + "<td>" +
           escaped(one.note) + "</tr>\n";
  return out + "</table></details>\n";
}

std::string claims_section(const std::vector<Claim>& claims) {
  std::string out =
      "<h2 id=\"claims\">The claims</h2>\n<table><tr><th><th>the paper<th>computed<th>agree<th>why</tr>\n";
  for (const Claim& claim : claims) {
    const std::string agree(name(claim.agreement));
    out += "<tr><td><a href=\"#claim-" + claim.id + "\">" + claim.id + "</a><td>" + escaped(claim.printed) + "<td>" +
           escaped(claim.computed) + "<td class=\"" + agree + "\">" + agree + "<td>" + escaped(claim.explanation) +
           "</tr>\n";
  }
  out +=
      "</table>\n<p>Window edges are found by following the attractor from inside and bisecting on its class until the "
      "edge is enclosed in "
      "5·10<sup>-5</sup> of ω. Near a loss of stability a class is hard to tell: how far, the multipliers say. Of each "
      "place only the decimals are printed that this leaves, the last one off by at most one. A class after an arrow "
      "is what a long transient leads to just "
      "beyond the edge. All numbers: "
      "<a href=\"claims.json\">claims.json</a>.</p>\n";
  for (const Claim& claim : claims) out += quantity_table(claim);
  return out;
}

std::string timing_section(const std::vector<Part>& parts) {
  std::string out = "<h2 id=\"timing\">Where the time went</h2>\n<table><tr><th>part<th>seconds</tr>\n";
  char text[32];
  double total = 0.0;
  const auto row = [&](const std::string& name, double seconds) {
    std::snprintf(text, sizeof text, "%.1f", seconds);
    out += "<tr><td>" + escaped(name) + "<td>" + text + "</tr>\n";
  };
  for (const Part& part : parts) {
    row(part.name, part.seconds);
    total += part.seconds;
  }
  row("together", total);
  return out + "</table>\n";
}

}  // namespace

std::string index_html(const Options& options, const std::vector<Claim>& claims, const std::vector<Part>& parts) {
  std::string out = head;
  out += "<h1>“The Stick-Slip Vibration and Bifurcation of a Vibro-Impact System with Dry Friction”, computed</h1>\n";
  out +=
      "<p>Every figure and claim of the paper, from an exact engine: each segment of the motion is a closed form and "
      "each impact, reversal, stick and "
      "release a certified root. <code>" +
      escaped(options.command) + "</code>, slapstick " SLAPSTICK_VERSION +
      (options.quick ? ", <b>quick version on coarse grids</b>" : "") + ".</p>\n";
  out +=
      "<p>Parameters: eq. (9) of the paper with r = 0.8 (printed: R = 0.08), f_k = f_s and μ_c = 5 (neither is "
      "printed). "
      "<a href=\"#claims\">Claims</a> · <a href=\"#print\">What the printed values give</a> · <a "
      "href=\"#timing\">Timing</a></p>\n";
  for (const Shown& shown : figures) out += figure_section(options, shown);
  return out + claims_section(claims) + timing_section(parts) + "</body></html>\n";
}

}  // namespace slapstick::paper

/// Translates text from gnuplot's enhanced notation.
#include "latex.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace slapstick::figure {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 45> latex_signs = {
    {{"\u03b1", "\\alpha"},      {"\u03b2", "\\beta"},         {"\u03b3", "\\gamma"},   {"\u03b4", "\\delta"},
     {"\u03b5", "\\varepsilon"}, {"\u03b6", "\\zeta"},         {"\u03b7", "\\eta"},     {"\u03b8", "\\theta"},
     {"\u03b9", "\\iota"},       {"\u03ba", "\\kappa"},        {"\u03bb", "\\lambda"},  {"\u03bc", "\\mu"},
     {"\u03bd", "\\nu"},         {"\u03be", "\\xi"},           {"\u03c0", "\\pi"},      {"\u03c1", "\\rho"},
     {"\u03c3", "\\sigma"},      {"\u03c4", "\\tau"},          {"\u03c5", "\\upsilon"}, {"\u03c6", "\\varphi"},
     {"\u03c7", "\\chi"},        {"\u03c8", "\\psi"},          {"\u03c9", "\\omega"},   {"\u0393", "\\Gamma"},
     {"\u0394", "\\Delta"},      {"\u0398", "\\Theta"},        {"\u039b", "\\Lambda"},  {"\u039e", "\\Xi"},
     {"\u03a0", "\\Pi"},         {"\u03a3", "\\Sigma"},        {"\u03a6", "\\Phi"},     {"\u03a8", "\\Psi"},
     {"\u03a9", "\\Omega"},      {"\u03d5", "\\phi"},          {"\u2212", "-"},         {"\u00d7", "\\times"},
     {"\u00b7", "\\cdot"},       {"\u00b5", "\\mathrm{\\mu}"}, {"\u00b0", "^{\\circ}"}, {"\u221e", "\\infty"},
     {"\u00b2", "^{2}"},         {"\u00b3", "^{3}"},           {"\u2264", "\\leq"},     {"\u2265", "\\geq"},
     {"\u00b1", "\\pm"}}};

/// One character, or a command that stands for it, from position `at` on.
class Reader {
 public:
  Reader(std::string_view text, Dialect dialect) : text_(text), latex_(dialect == Dialect::latex) {}

  std::string all() {
    std::string out;
    while (at_ < text_.size()) out += next(false);
    return out;
  }

 private:
  /// @param math  inside dollars already
  std::string next(bool math) {
    const char c = text_[at_];
    if ((c == '_' || c == '^') && at_ + 1 < text_.size()) {
      ++at_;
      const std::string script = c + ("{\\mathrm{" + group() + "}}");
      return math ? script : "$" + script + "$";
    }
    if (c == '{') return braces(math);
    if (c == '\\' && at_ + 1 < text_.size()) ++at_;  // the next one is meant as it is
    return sign(math);
  }

  /// What a script applies to, in mathematics: one character, or what is between braces.
  std::string group() {
    if (text_[at_] != '{') return next(true);
    ++at_;
    return inside();
  }

  std::string inside() {
    std::string out;
    while (at_ < text_.size() && text_[at_] != '}') out += next(true);
    if (at_ < text_.size()) ++at_;
    return out;
  }

  /// {/:Italic x} and other fonts, or a group.
  std::string braces(bool math) {
    ++at_;
    bool italic = false;
    if (at_ < text_.size() && text_[at_] == '/') {
      const std::size_t space = std::min(text_.find(' ', at_), text_.size());
      italic = text_.substr(at_, space - at_).find("Italic") != std::string_view::npos;
      at_ = std::min(space + 1, text_.size());
    }
    const std::string body = inside();
    const std::string set = (italic ? "\\mathit{" : "\\mathrm{") + body + "}";
    return math ? set : "$" + set + "$";
  }

  /// A character as it is, escaped where it means something.
  std::string sign(bool math) {
    for (const auto& [utf8, command] : latex_signs) {
      if (text_.substr(at_, utf8.size()) != utf8) continue;
      at_ += utf8.size();
      if (!latex_ && !math) return std::string(utf8);
      const std::string spaced = std::string(command) + (math && command.front() == '\\' ? " " : "");
      return math ? spaced : "$" + std::string(command) + "$";
    }
    const char c = text_[at_++];
    if (c == ' ' && math) return "\\ ";
    if (std::string_view("#$%&_{}").find(c) != std::string_view::npos && (latex_ || math || c == '$'))
      return std::string("\\") + c;
    if (latex_ && c == '\\') return "\\textbackslash{}";
    if (latex_ && c == '~') return "\\textasciitilde{}";
    if (latex_ && c == '^') return "\\textasciicircum{}";
    return std::string(1, c);
  }

  std::string_view text_;
  bool latex_;
  std::size_t at_ = 0;
};

}  // namespace

std::string translate(std::string_view enhanced, Dialect dialect) { return Reader(enhanced, dialect).all(); }

Figure translated(Figure figure, Dialect dialect) {
  const auto change = [&](std::string& text) { text = translate(text, dialect); };
  for (Panel& panel : figure.panels) {
    for (std::string* text : {&panel.x_label, &panel.y_label, &panel.tag, &panel.title}) change(*text);
    for (Points& points : panel.points) change(points.label);
    for (Line& line : panel.lines) change(line.label);
    for (Mark& mark : panel.marks) change(mark.label);
    for (Key& key : panel.keys) change(key.label);
  }
  return figure;
}

std::string latex_format(const std::string& format) { return format.empty() ? format : "$" + format + "$"; }

}  // namespace slapstick::figure

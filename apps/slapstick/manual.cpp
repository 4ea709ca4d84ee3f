/// Writes the manual pages slapstick(1) and slapstick-VERB(1), in the man macros of groff and mandoc.
#include <algorithm>

#include "base/nearest.hpp"
#include "catalogue.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

/// Running text: a hyphen is one that can be copied, and no line begins with what would be a request.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) safe += "\\&";
    switch (c) {
      case '-':
        safe += "\\-";
        break;
      case '\\':
        safe += "\\e";
        break;
      case '^':
        safe += "\\(ha";
        break;
      case '~':
        safe += "\\(ti";
        break;
      case '`':
        safe += "\\(ga";
        break;
      case '\'':
        safe += "\\(aq";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

/// The argument of a macro.
std::string in_macro(const std::string& text) {
  std::string safe = "\"";
  for (const char c : roff(text)) safe += c == '"' ? std::string("\\(dq") : std::string(1, c);
  return safe + "\"";
}

std::string upper(std::string text) {
  for (char& c : text)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return text;
}

std::string page_head(const std::string& page, const std::string& summary) {
  return ".TH " + upper(in_macro(page)) + " 1 \"\" \"slapstick " SLAPSTICK_VERSION "\" \"User Commands\"\n.SH NAME\n" +
         roff(page) + " \\- " + roff(summary) + "\n.SH SYNOPSIS\n";
}

/// An entry of a list: what it is called, and below what it is.
std::string list_entry(const std::string& term, const std::string& text) {
  return ".TP\n" + term + "\n" + roff(text) + "\n";
}

std::string option_entry(const ArgumentFact& fact) {
  if (fact.value.empty()) return list_entry(".B " + roff(fact.name), fact.described());
  std::string value;
  for (const char c : fact.value) value += c == ' ' ? std::string("\\ ") : std::string(1, c);
  return list_entry(".BI " + roff(fact.name) + " \" " + in_macro(value).substr(1), fact.described());
}

/// The paragraphs at the end of a help: lines that begin with two spaces are shown as they are.
std::string note_lines(const std::string& text) {
  std::string out;
  bool shown = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    const bool code = line.starts_with("  ");
    if (code != shown) out += code ? std::string(out.empty() ? "" : ".PP\n") + ".nf\n.RS 4\n" : ".RE\n.fi\n.PP\n";
    shown = code;
    if (line.empty()) {
      if (!out.ends_with(".PP\n")) out += ".PP\n";
    } else {
      out += roff(code ? line.substr(2) : line) + "\n";
    }
    begin = end + 1;
  }
  return shown ? out + ".RE\n.fi\n" : out;
}

constexpr const char* status_section =
    ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n2\nbad input; the message names the argument, the file, the line and the key\n"
    ".TP\n3\nthe numerics did not succeed; the message says what, where, and what to try\n"
    ".TP\n4\na file could not be read or written\n.TP\n130\nended by Ctrl\\-C\n";

std::string see_also(const std::vector<std::string>& pages) {
  std::string text = ".SH SEE ALSO\n";
  for (std::size_t i = 0; i < pages.size(); ++i)
    text += ".BR " + roff(pages[i]) + (i + 1 < pages.size() ? " (1),\n" : " (1)\n");
  return text;
}

std::string verb_page(const VerbFacts& verb) {
  const auto positional = [](const ArgumentFact& fact) { return fact.kind == ArgumentFact::Kind::positional; };
  std::string text = page_head("slapstick-" + verb.name, verb.summary) + ".B slapstick " + roff(verb.name) + "\n";
  std::string arguments, options;
  for (const ArgumentFact& fact : verb.arguments) {
    if (positional(fact)) text += (fact.required ? ".I " + roff(fact.name) : ".RI [ " + roff(fact.name) + " ]") + "\n";
    (positional(fact) ? arguments : options) +=
        positional(fact) ? list_entry(".I " + roff(fact.name), fact.described()) : option_entry(fact);
  }
  text += "[options]\n";
  if (!arguments.empty()) text += ".SH ARGUMENTS\n" + arguments;
  text += ".SH OPTIONS\n" + options + list_entry(".BR \\-h \", \" \\-\\-help", "print these options");
  if (!verb.notes.empty()) text += ".SH NOTES\n" + note_lines(verb.notes);
  return text + status_section + see_also({"slapstick"});
}

std::string program_page(const std::vector<VerbFacts>& verbs) {
  std::string text =
      page_head("slapstick", "exact simulation of oscillators that stick, slip and hit stops") +
      ".B slapstick\n.I VERB MODEL\n[\\fB\\-\\-set\\fR \\fINAME\\fR=\\fIVALUE\\fR]... [options]\n.SH DESCRIPTION\n"
      "A model is a built\\-in name or the path of a .toml model file.\n"
      "Results go to standard output or to the file of\n.BR \\-\\-out ,\nmessages to standard error.\n.SH VERBS\n";
  std::vector<std::string> pages;
  for (const VerbFacts& verb : verbs) {
    text += list_entry(".B " + roff(verb.name), verb.summary);
    pages.push_back("slapstick-" + verb.name);
  }
  pages.emplace_back("slapstick-verify");
  std::sort(pages.begin(), pages.end());
  text += ".SH OPTIONS\n" + list_entry(".B \\-\\-version", "print the version") +
          list_entry(".BR \\-h \", \" \\-\\-help", "list the verbs");
  text += ".SH EXAMPLES\n" +
          note_lines(
              "  slapstick show vibro-impact\n  slapstick simulate vibro-impact --periods 50 --plot motion.png\n"
              "  slapstick diagram vibro-impact --sweep omega=0.5:10:1000 --plot diagram.png --out impacts.csv\n");
  return text + status_section + see_also(pages);
}

}  // namespace

std::string manual(const std::string& page) {
  const std::vector<VerbFacts> verbs = catalogue();
  if (page == "slapstick") return program_page(verbs);
  std::vector<std::string> names = {"slapstick"};
  for (const VerbFacts& verb : verbs) {
    if (verb.name == page) return verb_page(verb);
    names.push_back(verb.name);
  }
  throw InputError("--man: there is no page of " + in_quotes(page) + suggestion(page, names));
}

}  // namespace slapstick::app

/// Writes the scripts by which shells complete the program's arguments.
#include <algorithm>

#include "base/text.hpp"
#include "catalogue.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::app {
namespace {

using Kind = ArgumentFact::Kind;

std::string joined(const std::vector<std::string>& words) { return slapstick::joined(words, " "); }

/// In single quotes of a shell, on one line.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c == '\n' ? ' ' : c);
  return safe + "'";
}

std::vector<std::string> verb_names(const std::vector<VerbFacts>& verbs) {
  std::vector<std::string> all;
  for (const VerbFacts& verb : verbs) all.push_back(verb.name);
  return all;
}

std::vector<std::string> option_names(const VerbFacts& verb) {
  std::vector<std::string> all = {"--help"};
  for (const ArgumentFact& fact : verb.arguments)
    if (fact.kind != Kind::positional) all.push_back(fact.name);
  return all;
}

bool takes_model(const VerbFacts& verb) {
  return std::any_of(verb.arguments.begin(), verb.arguments.end(),
                     [](const ArgumentFact& fact) { return fact.name == "MODEL"; });
}

/// What the value of an option names: quantities of the model, its parameters, its stops, or nothing that is known.
std::string names_of(const ArgumentFact& fact) {
  if (fact.value.starts_with("Q")) return "quantities";
  if (fact.value == "STOP") return "stops";
  return fact.value.starts_with("NAME") || fact.value == "A,B" ? "parameters" : "";
}

/// A value of several names, and one of a name with its number.
bool is_list(const ArgumentFact& fact) { return fact.value.ends_with(",..") || fact.value == "A,B"; }
bool is_assignment(const ArgumentFact& fact) { return fact.value.starts_with("NAME="); }

/// Reads `slapstick quantities MODEL`: the names of a kind. A stop is what has a gap.
constexpr const char* names_program =
    R"('$2 == "name" { n = $4 } $2 == "kind" && (k == "quantities" || k == "parameters" && $4 == "parameter") { print n })"
    R"( $2 == "kind" && k == "stops" && sub("^gap_", "", n) { print n }')";

std::string shell_names() {
  return std::string("_slapstick_names() {\n  slapstick quantities \"$1\" 2>/dev/null |\n    awk -F'\"' -v k=\"$2\" ") +
         names_program + "\n}\n";
}

std::string bash(const std::vector<VerbFacts>& verbs) {
  std::string text = "# bash completion of slapstick: source <(slapstick completion bash)\n";
  text += shell_names();
  text +=
      "_slapstick() {\n  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} "
      "model=${COMP_WORDS[2]}\n"
      "  local options='' positional='' models=" +
      quoted(joined(builtin_models())) +
      "\n  local before=''\n  [[ $cur == *,* ]] && before=${cur%,*},\n  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n    COMPREPLY=($(compgen -W " +
      quoted(joined(verb_names(verbs)) + " --help --version") +
      " -- \"$cur\"))\n    return\n  fi\n"
      "  case \"$verb $prev\" in\n";
  for (const VerbFacts& verb : verbs)
    for (const ArgumentFact& fact : verb.arguments) {
      const std::string names = names_of(fact), here = "    " + quoted(verb.name + " " + fact.name) + ") ";
      if (fact.kind == Kind::choice)
        text += here + "COMPREPLY=($(compgen -W " + quoted(joined(fact.words)) + " -- \"$cur\")); return ;;\n";
      if (names.empty()) continue;
      text += here + "before=" + (is_list(fact) ? "$before" : "''") + "; COMPREPLY=($(compgen -P \"$before\"" +
              (is_assignment(fact) ? " -S =" : "") + " -W \"$(_slapstick_names \"$model\" " + names +
              ")\" -- \"${cur#\"$before\"}\"))" + (is_assignment(fact) ? "; compopt -o nospace 2>/dev/null" : "") +
              "; return ;;\n";
    }
  text += "  esac\n  case \"$verb\" in\n";
  for (const VerbFacts& verb : verbs) {
    text += "    " + verb.name + ") options=" + quoted(joined(option_names(verb)));
    text += std::string("; positional=") + (takes_model(verb) ? "1" : "") + " ;;\n";
  }
  return text +
         "  esac\n  if [[ $cur == -* ]]; then\n    COMPREPLY=($(compgen -W \"$options\" -- \"$cur\"))\n"
         "  elif ((COMP_CWORD == 2)) && [[ $positional ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$models\" -- \"$cur\") $(compgen -f -X '!*.toml' -- \"$cur\"))\n  fi\n}\n"
         "complete -o bashdefault -o default -F _slapstick slapstick\n";
}

/// The text of a specification of _arguments: brackets and colons have a meaning there.
std::string zsh_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string zsh_value(const ArgumentFact& fact) {
  if (fact.kind == Kind::flag) return "";
  const std::string names = names_of(fact), what = ":" + zsh_text(fact.value) + ":";
  if (fact.kind == Kind::choice) return what + "(" + joined(fact.words) + ")";
  if (!names.empty())
    return what + "{" + (is_list(fact) ? "compset -P \"*,\"; " : "") + "compadd " +
           (is_assignment(fact) ? "-S= " : "") + "-- $(_slapstick_names \"$words[2]\" " + names + ")}";
  return what + (fact.value.starts_with("F") ? "_files" : "");
}

std::string zsh(const std::vector<VerbFacts>& verbs) {
  std::string text = "#compdef slapstick\n# zsh completion of slapstick: a file _slapstick in a folder of $fpath\n";
  text += shell_names();
  text += "_slapstick() {\n  local -a verbs\n  verbs=(\n";
  for (const VerbFacts& verb : verbs) text += "    " + quoted(verb.name + ":" + verb.summary) + "\n";
  text +=
      "  )\n  if ((CURRENT == 2)); then\n    _describe verb verbs\n    return\n  fi\n  local verb=$words[2]\n  shift "
      "words\n  ((CURRENT--))\n  case $verb in\n";
  for (const VerbFacts& verb : verbs) {
    text += "    " + verb.name + ")\n      _arguments";
    if (takes_model(verb)) text += " \\\n        " + quoted("1:MODEL:(" + joined(builtin_models()) + ")");
    for (const ArgumentFact& fact : verb.arguments)
      if (fact.kind != Kind::positional)
        text += " \\\n        " + quoted((fact.kind == Kind::repeated ? "*" : "") + fact.name + "[" +
                                         zsh_text(fact.described()) + "]" + zsh_value(fact));
    text += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return text +
         "  esac\n}\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then\n  _slapstick \"$@\"\nelse\n  compdef "
         "_slapstick slapstick\nfi\n";
}

std::string fish(const std::vector<VerbFacts>& verbs) {
  std::string text =
      "# fish completion of slapstick: slapstick completion fish | source\n"
      "# __slapstick_names KIND SUFFIX [list]: with what stands before the last comma, of a list\n"
      "function __slapstick_names\n  set -l words (commandline -opc)\n  set -l before ''\n"
      "  test \"$argv[3]\" = list; and set before (string match -r '^.*,' -- (commandline -ct); or echo '')\n"
      "  for name in (slapstick quantities $words[3] 2>/dev/null | awk -F'\"' -v k=\"$argv[1]\" ";
  text += std::string(names_program) + ")\n    echo $before$name$argv[2]\n  end\nend\n";
  for (const VerbFacts& verb : verbs) {
    text += "complete -c slapstick -n __fish_use_subcommand -f -a " + verb.name + " -d " + quoted(verb.summary) + "\n";
    const std::string here = "complete -c slapstick -n '__fish_seen_subcommand_from " + verb.name + "'";
    if (takes_model(verb)) text += here + " -a " + quoted(joined(builtin_models())) + "\n";
    for (const ArgumentFact& fact : verb.arguments) {
      if (fact.kind == Kind::positional) continue;
      const std::string names = names_of(fact);
      text += here + " -l " + fact.name.substr(2) + (fact.kind == Kind::flag ? "" : " -r") + " -d " +
              quoted(fact.described());
      if (fact.kind == Kind::choice) text += " -f -a " + quoted(joined(fact.words));
      if (!names.empty())
        text += " -f -a '(__slapstick_names " + names + (is_assignment(fact) ? " =" : " \"\"") +
                (is_list(fact) ? " list" : "") + ")'";
      text += "\n";
    }
  }
  return text;
}

}  // namespace

std::string completion(const std::string& shell) {
  const std::vector<VerbFacts> verbs = catalogue();
  if (shell == "bash") return bash(verbs);
  if (shell == "zsh") return zsh(verbs);
  if (shell == "fish") return fish(verbs);
  throw InputError("SHELL: bash, zsh and fish are known");
}

}  // namespace slapstick::app

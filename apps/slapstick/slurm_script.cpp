/// Writes the script of a job array.
#include "slurm_script.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <system_error>

#include "base/text.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::app {
namespace {

namespace fs = std::filesystem;

/// A word that the shell takes literally.
std::string quoted(const std::string& word) {
  if (word.find('\n') != std::string::npos || word.find('\0') != std::string::npos)
    throw InputError("--slurm: " + in_quotes(word) + " has a line break, which a script cannot have there");
  if (!word.empty() &&
      word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./") ==
          std::string::npos)
    return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string absolute(const std::string& path) { return path.empty() ? path : fs::absolute(path).string(); }

std::string this_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? "slapstick" : program.string();
}

std::string map_words(const MapOptions& options, const std::vector<std::string>& all) {
  const bool file = options.model.source.ends_with(".toml");
  std::string words = "map " + quoted(file ? absolute(options.model.source) : options.model.source);
  for (const std::string& set : options.model.sets) words += " --set " + quoted(set);
  // Of each level and start only what `map` takes with it.
  const auto belongs = [&](const std::string& name) {
    if (name == "--periods") return options.analysis.level == "quick";
    if (name == "--transient" || name == "--most-periods" || name == "--exponent-periods")
      return options.analysis.level == "full";
    if (name == "--direction") return options.start == "carry";
    if (name == "--seed") return options.start != "carry" && options.start != "reset";
    return name != "--measured-periods" || !options.of.empty();
  };
  for (std::size_t i = 0; i + 1 < all.size(); i += 2)
    if (belongs(all[i])) words += " " + all[i] + " " + quoted(all[i + 1]);
  return words;
}

std::string export_line(const SlurmWish& wish) {
  if (wish.out.empty() && wish.plot.empty()) return {};
  std::string line = "  \"$slapstick\" store export \"$whole\"";
  for (const auto& [name, value] : {std::pair{"--out", absolute(wish.out)}, std::pair{"--plot", absolute(wish.plot)},
                                    std::pair{"--plot-size", wish.plot_size}, std::pair{"--show", wish.show}})
    if (!value.empty()) line += std::string(" ") + name + " " + quoted(value);
  for (const std::string& inset : wish.insets) line += " --inset " + quoted(inset);
  return line + "\n";
}

/// A ~name~ is filled in; no other ~ stands here.
constexpr std::string_view script = R"sh(#!/bin/bash
#SBATCH --job-name=slapstick-map
#SBATCH --array=1-~tasks~
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@60
#SBATCH --output=~stem~-%a.log
# sbatch THIS computes the map in ~tasks~ tasks; each goes on where it was ended. The last one joins the stores.
# Without Slurm: seq ~tasks~ | parallel bash THIS {}
set -u
slapstick=~slapstick~
stem=~stem~
whole=~whole~
task=${SLURM_ARRAY_TASK_ID:-${1:?the number of a task is wanted, 1 to ~tasks~}}
rm -f "$stem-$task.done"
"$slapstick" ~map~ \
  --shard "$task/~tasks~" --store "$stem-$task.db" --resume --threads "${SLURM_CPUS_PER_TASK:-1}" &
program=$!
trap 'kill -TERM "$program"' TERM  # the time is nearly over: the program keeps what is complete
wait "$program"; status=$?
while kill -0 "$program" 2>/dev/null; do wait "$program"; status=$?; done
case $status in
  0) touch "$stem-$task.done" ;;
  130 | 143) [ -z "${SLURM_JOB_ID:-}" ] || scontrol requeue "$SLURM_JOB_ID"; exit $status ;;
  *) exit $status ;;
esac
for each in $(seq ~tasks~); do [ -e "$stem-$each.done" ] || exit 0; done
parts=()
for each in $(seq ~tasks~); do parts+=("$stem-$each.db"); done
exec 9>"$stem.lock"
flock 9  # of those that see all others done one joins the stores
if [ ! -e "$whole" ]; then
  rm -f "$stem-merged.db"
  "$slapstick" store merge "${parts[@]}" --out "$stem-merged.db" | grep -q '"complete": true' || exit 1
  mv "$stem-merged.db" "$whole"
~export~fi
)sh";

/// The text with the value of each ~name~ in its place. A ~ in a value stays.
std::string filled(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string result;
  for (bool name = false;; name = !name) {
    const std::size_t end = std::min(text.find('~'), text.size());
    const std::string_view piece = text.substr(0, end);
    result += name ? values.at(piece) : std::string(piece);
    if (end == text.size()) return result;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

std::string slurm_script(const MapOptions& options, const std::vector<std::string>& words, const SlurmWish& wish) {
  const std::string whole = absolute(wish.store), stem = fs::path(whole).replace_extension().string();
  return filled(script, {{"tasks", std::to_string(wish.tasks)},
                         {"slapstick", quoted(this_program())},
                         {"stem", quoted(stem)},
                         {"whole", quoted(whole)},
                         {"map", map_words(options, words)},
                         {"export", export_line(wish)}});
}

}  // namespace slapstick::app

/// Writes the script of a job array.
#include "slurm_script.hpp"

#include <filesystem>
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
  if (!word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./") == std::string::npos)
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
    if (name == "--periods") return options.level == "quick";
    if (name == "--transient" || name == "--most-periods" || name == "--exponent-periods") return options.level == "full";
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

}  // namespace

std::string slurm_script(const MapOptions& options, const std::vector<std::string>& words, const SlurmWish& wish) {
  const std::string whole = absolute(wish.store), stem = fs::path(whole).replace_extension().string();
  const std::string tasks = std::to_string(wish.tasks);
  return "#!/bin/bash\n"
         "#SBATCH --job-name=slapstick-map\n"
         "#SBATCH --array=1-" + tasks + "\n"
         "#SBATCH --cpus-per-task=1\n"
         "#SBATCH --requeue\n"
         "#SBATCH --open-mode=append\n"
         "#SBATCH --signal=B:TERM@60\n"
         "#SBATCH --output=" + quoted(stem) + "-%a.log\n"
         "# sbatch THIS computes the map in " + tasks + " tasks; each goes on where it was ended. The last one joins the stores.\n"
         "# Without Slurm: seq " + tasks + " | parallel bash THIS {}\n"
         "set -u\n"
         "slapstick=" + quoted(this_program()) + "\n"
         "stem=" + quoted(stem) + "\n"
         "whole=" + quoted(whole) + "\n"
         "task=${SLURM_ARRAY_TASK_ID:-${1:?the number of a task is wanted, 1 to " + tasks + "}}\n"
         "rm -f \"$stem-$task.done\"\n"
         "\"$slapstick\" " + map_words(options, words) + " \\\n"
         "  --shard \"$task/" + tasks + "\" --store \"$stem-$task.db\" --resume --threads \"${SLURM_CPUS_PER_TASK:-1}\" &\n"
         "program=$!\n"
         "trap 'kill -TERM \"$program\"' TERM  # the time is nearly over: the program keeps what is complete\n"
         "wait \"$program\"; status=$?\n"
         "while kill -0 \"$program\" 2>/dev/null; do wait \"$program\"; status=$?; done\n"
         "case $status in\n"
         "  0) touch \"$stem-$task.done\" ;;\n"
         "  130 | 143) [ -z \"${SLURM_JOB_ID:-}\" ] || scontrol requeue \"$SLURM_JOB_ID\"; exit $status ;;\n"
         "  *) exit $status ;;\n"
         "esac\n"
         "for each in $(seq " + tasks + "); do [ -e \"$stem-$each.done\" ] || exit 0; done\n"
         "parts=()\n"
         "for each in $(seq " + tasks + "); do parts+=(\"$stem-$each.db\"); done\n"
         "exec 9>\"$stem.lock\"\n"
         "flock 9  # of those that see all others done one joins the stores\n"
         "if [ ! -e \"$whole\" ]; then\n"
         "  rm -f \"$stem-merged.db\"\n"
         "  \"$slapstick\" store merge \"${parts[@]}\" --out \"$stem-merged.db\" | grep -q '\"complete\": true' || exit 1\n"
         "  mv \"$stem-merged.db\" \"$whole\"\n" +
         export_line(wish) + "fi\n";
}

}  // namespace slapstick::app

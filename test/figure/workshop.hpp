#pragma once
/// For the tests of figures: a folder of their own, and gnuplot as a second reader of PNG files.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace workshop {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() {
    std::string path = (fs::temp_directory_path() / "slapstick-figure-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr) throw std::runtime_error("no scratch folder");
    path_ = path;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path operator/(const std::string& name) const { return path_ / name; }
  const fs::path& path() const { return path_; }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

 private:
  fs::path path_;
};

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void save(const fs::path& file, const std::string& contents) {
  std::ofstream(file, std::ios::binary) << contents;
}

inline bool gnuplot_exists() { return std::system("gnuplot --version > /dev/null 2>&1") == 0; }

/// Runs gnuplot as an author would, in the folder of the script.
inline bool redraw(const fs::path& folder, const std::string& script) {
  return std::system(("cd '" + folder.string() + "' && gnuplot '" + script + "' > /dev/null 2>&1").c_str()) == 0;
}

struct Pixel {
  int column = 0, row = 0;  ///< from the lower left
  int red = 0, green = 0, blue = 0, alpha = 0;
};

/// What another program sees in a PNG file.
inline std::vector<Pixel> pixels(const fs::path& png) {
  const std::string table = png.string() + ".txt";
  save(png.string() + ".gp",
       "set table '" + table + "'\nplot '" + png.string() + "' binary filetype=png using 1:2:3:4 with rgbalpha\n");
  if (std::system(("gnuplot '" + png.string() + ".gp'").c_str()) != 0)
    throw std::runtime_error("gnuplot cannot read " + png.string());
  std::vector<Pixel> out;
  std::ifstream in(table);
  for (std::string line; std::getline(in, line);) {
    double x = 0, y = 0, r = 0, g = 0, b = 0, a = 255;
    if (line.empty() || line[0] == '#' ||
        std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf %lf", &x, &y, &r, &g, &b, &a) < 5)
      continue;
    out.push_back({static_cast<int>(x), static_cast<int>(y), static_cast<int>(r), static_cast<int>(g),
                   static_cast<int>(b), static_cast<int>(a)});
  }
  return out;
}

}  // namespace workshop

/// Tables and JSON give back the same doubles.
#include "io/table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>

#include "io/json.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick {
namespace {

namespace fs = std::filesystem;
constexpr double infinity = std::numeric_limits<double>::infinity();

fs::path scratch() { return fs::temp_directory_path() / ("slapstick-table-" + std::to_string(::getpid()) + ".csv"); }

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Number, every_double_reads_back_as_itself) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200000; ++i) {
    const auto bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(std::strtod(number_text(value).c_str(), nullptr), value);
  }
  EXPECT_EQ(number_text(2.2), "2.2000000000000002");
  EXPECT_EQ(number_text(1.0), "1");
  EXPECT_EQ(number_text(5e-324), "4.9406564584124654e-324");
  EXPECT_EQ(number_text(-0.0), "-0");
}

TEST(Number, what_is_not_finite_has_a_word) {
  EXPECT_EQ(number_text(infinity), "inf");
  EXPECT_EQ(number_text(-infinity), "-inf");
  EXPECT_EQ(number_text(std::nan("")), "nan");
  EXPECT_EQ(number_text(-std::nan("")), "nan");
}

TEST(CsvWriter, rows_and_quotes) {
  const auto path = scratch();
  CsvWriter table(path, {"time", "kind", "x1", "v1", "n"});
  table.number(0.5).word("impact").numbers({-0.5, 2}).integer(-7).end_row();
  table.number(1).word("a,\"b\"\n").numbers({infinity, 0}).integer(0).end_row();
  table.commit();
  EXPECT_EQ(content(path), "time,kind,x1,v1,n\n0.5,impact,-0.5,2,-7\n1,\"a,\"\"b\"\"\n\",inf,0,0\n");
  fs::remove(path);
}

TEST(CsvWriter, ragged_row_is_a_programming_error_and_leaves_no_file) {
  const auto path = scratch();
  {
    CsvWriter table(path, {"a", "b"});
    table.number(1);
    EXPECT_THROW(table.commit(), std::logic_error);
    EXPECT_THROW(table.end_row(), std::logic_error);
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(CsvWriter, unwritable_place_is_named) {
  EXPECT_THROW(CsvWriter("/dev/null/x.csv", {"a"}), StorageError);
  CsvWriter full("/dev/full", {"a"});
  EXPECT_THROW(full.commit(), StorageError);
}

TEST(Json, order_numbers_and_infinity) {
  Json json = Json::object();
  json.set("z", 0.1).set("a", 1).set("class", "1-1-I").set("p", infinity).set("ok", true).set("none", Json());
  json.set("state", Json::list({-0.5, 0.0}));
  json.set("a", 2);
  EXPECT_EQ(json.dump(-1),
            R"({"z":0.10000000000000001,"a":2,"class":"1-1-I","p":"inf","ok":true,"none":null,"state":[-0.5,0]})");
  EXPECT_EQ(Json::object().dump(-1), "{}");
  EXPECT_EQ(Json::list().dump(-1), "[]");
  EXPECT_EQ(Json("a\"\xff\n").dump(-1), "\"a\\\"\xEF\xBF\xBD\\n\"");
  EXPECT_THROW(Json(1.0).set("a", 1), std::logic_error);
}

TEST(Json, every_double_reads_back_as_itself) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 20000; ++i) {
    const auto bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(std::strtod(Json(value).dump().c_str(), nullptr), value);
  }
}

}  // namespace
}  // namespace slapstick

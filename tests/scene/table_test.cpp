// Tables as text and as bytes, and the tables of a run.
#include "scene/table.hpp"

#include <gtest/gtest.h>
#include <piblocks/two_blocks.hpp>

#include <cstring>
#include <limits>
#include <random>

#include "scene/run_tables.hpp"
#include "support/contains.hpp"

namespace piblocks {
namespace {

using Kind = TableLayout::Kind;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Index, a word of two bytes, a number that CSV leaves out, and one that it has.
Table small_table() {
  return Table({.columns = {{"k", Kind::index}, {"w", Kind::word}, {"low"}, {"x"}},
                .npy = "('k', '<i8'), ('w', '|S2'), ('low', '<f8'), ('x', '<f8')",
                .csv = "<k>,<w>,<x>",
                .json = R"({"k":"<k>","of":{"x":[<x>,<low>]},"w":<w>})",
                .words = {{"a", "1", "a."}, {"bcd", "\"bcd\"", "b."}}});
}

struct Values {
  std::vector<double> low;
  std::vector<double> x;
  std::vector<std::uint32_t> words;

  TableRows rows(const Integer& first, std::size_t begin, std::size_t end) const {
    return {.first = first + Integer(begin),
            .size = end - begin,
            .columns = {nullptr, words.data() + begin, low.data() + begin, x.data() + begin}};
  }
  TableRows rows(const Integer& first) const { return rows(first, 0, x.size()); }
};

std::string written(const Table& table, TableFormat format, const TableRows& rows) {
  fmt::memory_buffer out;
  table.append(format, rows, out);
  return {out.data(), out.size()};
}

/// 100 rows, many of which repeat a number of the row before.
Values random_values() {
  Values values;
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::uint64_t> bits;
  const auto number = [&] {
    const double any = std::bit_cast<double>(bits(random));
    return std::isfinite(any) ? any : -0.0;
  };
  for (int row = 0; row < 100; ++row) {
    const bool is_same = row > 0 && random() % 2 == 0;
    values.x.push_back(is_same ? values.x.back() : number());
    values.low.push_back(number());
    values.words.push_back(std::uint32_t(random() % 2));
  }
  return values;
}

TEST(Table, WritesEachFormat) {
  const Table table = small_table();
  const Values values{{1, 2, 2, 2}, {0.1, -0.0, 0, -1e300}, {0, 1, 1, 0}};
  const TableRows rows = values.rows(8);
  EXPECT_EQ(table.header(TableFormat::csv, 8, 4) + written(table, TableFormat::csv, rows),
            "k,w,x\n8,a,0.1\n9,bcd,0\n10,bcd,0\n11,a,-1e+300\n");
  EXPECT_EQ(table.header(TableFormat::jsonl, 8, 4) + written(table, TableFormat::jsonl, rows),
            R"({"k":"8","of":{"x":[0.1,1]},"w":1})"
            "\n"
            R"({"k":"9","of":{"x":[0,2]},"w":"bcd"})"
            "\n"
            R"({"k":"10","of":{"x":[0,2]},"w":"bcd"})"
            "\n"
            R"({"k":"11","of":{"x":[-1e+300,2]},"w":1})"
            "\n");
  const std::string bytes = written(table, TableFormat::npy, rows);
  ASSERT_EQ(table.row_bytes(), 26U);
  ASSERT_EQ(bytes.size(), 4 * table.row_bytes());
  for (std::size_t row = 0; row < 4; ++row) {
    const char* const at = bytes.data() + row * table.row_bytes();
    std::int64_t index = 0;
    std::array<double, 2> numbers{};
    std::memcpy(&index, at, sizeof index);
    std::memcpy(numbers.data(), at + 10, sizeof numbers);
    EXPECT_EQ(index, std::int64_t(8 + row));
    EXPECT_EQ(std::string(at + 8, 2), values.words[row] == 0 ? "a." : "b.");
    EXPECT_EQ(numbers[0], values.low[row]);
    EXPECT_EQ(numbers[1], values.x[row]);
  }
}

TEST(Table, ReadsBackAsTheSameNumbers) {
  const Values values = random_values();
  const std::string text = written(small_table(), TableFormat::csv, values.rows(0));
  std::size_t at = 0;
  for (const double x : values.x) {
    const std::size_t end = text.find('\n', at);
    EXPECT_EQ(std::stod(text.substr(text.rfind(',', end) + 1)), x);
    at = end + 1;
  }
  EXPECT_EQ(at, text.size());
}

TEST(Table, DoesNotDependOnHowManyRowsAreWrittenAtOnce) {
  const Table table = small_table();
  const Values values = random_values();
  const Integer first("-3");
  for (const auto format : {TableFormat::csv, TableFormat::jsonl, TableFormat::npy}) {
    const std::string all = written(table, format, values.rows(first));
    for (const std::size_t step : {1U, 7U, 64U}) {
      std::string parts;
      for (std::size_t row = 0; row < values.x.size(); row += step) {
        const std::size_t end = std::min(row + step, values.x.size());
        parts += written(table, format, values.rows(first, row, end));
      }
      EXPECT_TRUE(parts == all) << step;
    }
  }
}

TEST(Table, CountsAsFarAsNumbersGo) {
  const Table table({.columns = {{"k", Kind::index}}, .npy = "('k', '<i8')", .csv = "<k>"});
  const auto csv = [&](const char* first, std::size_t size, bool is_infinite = false) {
    return written(
        table, TableFormat::csv,
        {.first = Integer(first), .is_infinite = is_infinite, .size = size, .columns = {nullptr}});
  };
  EXPECT_EQ(csv("-11", 3), "-11\n-10\n-9\n");
  EXPECT_EQ(csv("-1", 3), "-1\n0\n1\n");
  EXPECT_EQ(csv("99999999999999999998", 3),
            "99999999999999999998\n99999999999999999999\n100000000000000000000\n");
  EXPECT_EQ(csv("5", 1, true), "infinite\n");
  EXPECT_EQ(csv("5", 0), "");
  const std::string many = csv("9", 500);
  EXPECT_TRUE(many.starts_with("9\n10\n11\n") && many.ends_with("\n508\n"));
}

TEST(Table, RefusesWhatAFormatCannotHold) {
  const Table table = small_table();
  for (const double x : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    const Values values{{0, 0}, {1, x}, {0, 0}};
    EXPECT_THROW(written(table, TableFormat::csv, values.rows(0)), SimulationError) << x;
  }
  const Integer largest("9223372036854775807");
  EXPECT_NO_THROW(table.header(TableFormat::npy, largest - 1, 2));
  EXPECT_NO_THROW(table.header(TableFormat::npy, largest + 9, 0)) << "there are no rows";
  EXPECT_THROW(table.header(TableFormat::npy, largest, 2), UsageError);
  EXPECT_THROW(table.header(TableFormat::npy, -largest - 1, 2), UsageError);
  EXPECT_NO_THROW(table.header(TableFormat::csv, largest, 2));
}

TEST(Table, HasTheHeaderOfNumpy) {
  for (const char* count : {"0", "31", "1000000000"}) {
    const std::string header = small_table().header(TableFormat::npy, 1, Integer(count));
    EXPECT_EQ(header.size() % 64, 0U);
    EXPECT_EQ(header.substr(0, 10), std::string("\x93NUMPY\x01\x00", 8) +
                                        char((header.size() - 10) % 256) +
                                        char((header.size() - 10) / 256));
    const std::string dictionary =
        "{'descr': [('k', '<i8'), ('w', '|S2'), ('low', '<f8'), ('x', '<f8')], "
        "'fortran_order': False, 'shape': (" +
        std::string(count) + ",), }";
    EXPECT_TRUE(header.substr(10).starts_with(dictionary)) << header;
    EXPECT_EQ(header.find_first_not_of(' ', 10 + dictionary.size()), header.size() - 1);
    EXPECT_EQ(header.back(), '\n');
  }
}

/// The rows of a run from its first collision to its last.
std::string log_text(const System& system, TableFormat format) {
  const auto log = make_log(system, Rational(100));
  const Table table = collision_table(system);
  fmt::memory_buffer out;
  read_collisions(*log, 1, log->last(),
                  [&](const TableRows& rows) { table.append(format, rows, out); });
  return table.header(format, 1, log->last()) + std::string(out.data(), out.size());
}

std::string state_at(const System& system, const Rational& time, bool has_bounds = false) {
  return state_text(state_table(system, has_bounds),
                    state_row(*make_log(system, Rational(100)), time, has_bounds));
}

TEST(RunTables, BlueAndRedHaveColumnsOfTheirOwn) {
  const System system = article_system(1);
  EXPECT_EQ(log_text(system, TableFormat::csv),
            "index,time,kind,x_blue,x_red,v_blue,v_red\n"
            "1,2,blocks,2,3,-1,0\n2,3.5,wall,0.5,3,1,0\n3,5,blocks,2,3,0,1\n");
  EXPECT_TRUE(log_text(system, TableFormat::jsonl)
                  .ends_with("\n{\"index\":\"3\",\"time\":5,\"kind\":\"blocks\",\"x_blue\":2,"
                             "\"x_red\":3,\"v_blue\":0,\"v_red\":1}\n"));
  EXPECT_EQ(state_at(system, 4), R"({"time":4,"collisions":"2","blue":{"position":1,"velocity":1},)"
                                 R"("red":{"position":3,"velocity":0}})");
  EXPECT_EQ(
      state_at(system, 4, true),
      R"({"time":4,"collisions":"2","blue":{"position":1,"position_bound":1.1102230246251565e-16,"velocity":1},)"
      R"("red":{"position":3,"position_bound":3.3306690738754696e-16,"velocity":0}})");
}

TEST(RunTables, OtherBodiesAreNumbered) {
  System line{1, {{1, {0}, {1}}, {1, {4}}, {std::nullopt, {9}}}};
  EXPECT_EQ(log_text(line, TableFormat::csv),
            "index,time,first,second,x_first,x_second,v_first,v_second\n"
            "1,3,1,2,3,4,0,1\n2,7,2,3,8,9,-1,0\n3,11,1,2,3,4,-1,0\n");
  EXPECT_EQ(state_at(line, 3), R"({"time":3,"collisions":"1","bodies":[{"position":3,)"
                               R"("velocity":0},{"position":4,"velocity":1},{"position":9,)"
                               R"("velocity":0}]})");
}

TEST(RunTables, BoundsAreThoseOfAnyTwoBlocks) {
  // In closed form, on the left and on the right of what does not move, in any order of the list.
  const System right{1, {{1, {0}, {1}}, {std::nullopt, {9}}, {1, {4}}}};
  const std::string bounds = state_at(right, Rational(10, 3), true);
  EXPECT_TRUE(bounds.starts_with(R"({"time":3.3333333333333335,"collisions":"1","bodies":[)"
                                 R"({"position":3,"position_bound":)"))
      << bounds;
  EXPECT_TRUE(
      testing_support::contains(bounds, R"({"position":9,"position_bound":0,"velocity":0})"));
  const StateRow row = state_row(*make_log(right), Rational(10, 3), true);
  ASSERT_EQ(row.numbers.size(), 1 + 3 * 3U);
  const double error = to_double(abs(Rational(row.numbers[3]) - Rational(13, 3)));
  EXPECT_GT(row.numbers[9], error);
  EXPECT_LT(row.numbers[9], 1e-14);

  const System four{1, {{1, {0}, {1}}, {1, {4}}, {1, {7}}, {std::nullopt, {9}}}};
  EXPECT_THROW(state_row(*make_log(four), 1, true), UsageError);
  EXPECT_THROW(state_row(*make_log(system_of({}), {}, {}, Engine::events), 1, true), UsageError);
}

TEST(RunTables, InAPlaneTheyHaveTwoCoordinates) {
  const System plane{2, {{1, {1, 3}, {0, -1}}}, {{"floor", {0, 0}, {0, 1}}}};
  EXPECT_EQ(log_text(plane, TableFormat::csv),
            "index,time,first,second,x_first,y_first,x_second,y_second,vx_first,vy_first,vx_second,"
            "vy_second\n1,2,1,floor,1,1,0,0,0,1,0,0\n");
  EXPECT_EQ(log_text(plane, TableFormat::jsonl),
            "{\"index\":\"1\",\"time\":2,\"first\":1,\"second\":\"floor\",\"first_after\":"
            "{\"position\":[1,1],\"velocity\":[0,1]},\"second_after\":{\"position\":[0,0],"
            "\"velocity\":[0,0]}}\n");
  EXPECT_EQ(collision_table(plane).row_type(),
            "[('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('first', '<i4'), "
            "('second', '<i4'), ('x_first', '<f8', (2,)), ('x_second', '<f8', (2,)), "
            "('v_first', '<f8', (2,)), ('v_second', '<f8', (2,))]");
  EXPECT_EQ(state_table(plane, false).row_type(),
            "[('time', '<f8'), ('count', '<i8'), ('positions', '<f8', (1, 2)), "
            "('velocities', '<f8', (1, 2))]");
  EXPECT_EQ(state_at(plane, 2),
            R"({"time":2,"collisions":"1","bodies":[{"position":[1,1],"velocity":[0,1]}]})");
}

}  // namespace
}  // namespace piblocks

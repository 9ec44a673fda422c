// SPDX-License-Identifier: MIT
// Sixty rows computed outside this project in 80-bit arithmetic (outside_values.csv), near and far field.
#include <pelage/reference/fiber.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace pelage::reference::test {
namespace {

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> made;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) made.push_back(cell);
    return made;
}

TEST(OutsideValues, EveryRowAgrees) {
    std::ifstream file(PELAGE_REFERENCE_TESTS "/outside_values.csv");
    ASSERT_TRUE(file);
    int near = 0, far = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#' || line[0] == 't') continue;
        const auto row = cells(line);
        ASSERT_EQ(row.size(), 15U) << line;
        const auto number = [&](std::size_t column) { return std::stod(row[column]); };
        const Fiber fiber{number(5), number(6), number(7), number(8) * degree, number(9)};
        const Angles angles = anglesFromDegrees(number(0), number(1), number(2), number(3));
        const bool isFar = row[4].empty();
        const Lobes s = isFar ? farField(fiber, angles).value : nearField(fiber, angles, number(4));
        ++(isFar ? far : near);
        for (std::size_t p = 0; p < 5; ++p) {
            const double expected = number(10 + p), value = p < 4 ? s.p[p] : s.total();
            EXPECT_NEAR(value, expected, 1e-9 * expected + 1e-12) << "lobe " << p << " of " << line;
        }
    }
    EXPECT_EQ(near, 40);
    EXPECT_EQ(far, 20);
}

}  // namespace
}  // namespace pelage::reference::test

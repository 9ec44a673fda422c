// SPDX-License-Identifier: MIT
// `pelage scatter`: rows of text to rows of results, first the reader and writer alone, then the whole command.
#include "scatter_rows.hpp"
#include "app_fixture.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <random>

namespace pelage::test {

namespace {

using app::readScatterRows;
using app::ScatterRows;
using app::writeScatterRows;

constexpr const char* header = "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,h,eta,beta_m,beta_n,alpha_deg,sigma_a\n";

ScatterRows rowsOf(const std::string& text) {
    // Cells are views of it, and tests look at them after this function.
    static std::vector<std::unique_ptr<std::string>> kept;
    kept.push_back(std::make_unique<std::string>(text));
    const auto read = readScatterRows(*kept.back(), "t.csv");
    EXPECT_TRUE(read) << read.error().text();
    return read ? *read : ScatterRows{};
}

std::string refusalOf(const std::string& text) {
    const auto read = readScatterRows(text, "t.csv");
    EXPECT_FALSE(read);
    return read ? "" : read.error().text();
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> found{""};
    for (const char c : text) {
        if (c == '\n') {
            found.emplace_back();
        } else {
            found.back() += c;
        }
    }
    found.pop_back();
    return found;
}

TEST(ScatterRows, ColumnsInAnyOrderAndMoreOfThem) {
    const ScatterRows read = rowsOf(
        "S_R,sigma_a, eta ,h,note,beta_n,beta_m,alpha_deg,phi_o_deg,theta_o_deg,phi_i_deg,theta_i_deg\n"
        "9,0.25,1.6,-0.5,any words,0.2,0.1,-3,40,30,20,10\n");
    ASSERT_EQ(read.rows.size(), 1U);
    EXPECT_TRUE(read.faults.empty());
    const app::ScatterTuple& t = read.rows[0].tuple;
    EXPECT_EQ(t.thetaI, 10);
    EXPECT_EQ(t.phiI, 20);
    EXPECT_EQ(t.thetaO, 30);
    EXPECT_EQ(t.phiO, 40);
    EXPECT_EQ(t.h, -0.5);
    EXPECT_EQ(t.eta, 1.6);
    EXPECT_EQ(t.betaM, 0.1);
    EXPECT_EQ(t.betaN, 0.2);
    EXPECT_EQ(t.alpha, -3);
    EXPECT_EQ(t.sigmaA, 0.25);
}

TEST(ScatterRows, CommentsAndBlankLinesAreNoRows) {
    const ScatterRows read = rowsOf(std::string("# what it is\n\n  \t\n") + header +
                                    "# one\n1,0,0,0,,1.5,0.3,0.3,0,0\n\n# two\n2,0,0,0,,1.5,0.3,0.3,0,0");
    ASSERT_EQ(read.rows.size(), 2U);
    EXPECT_EQ(read.rows[0].line, 6U);
    EXPECT_EQ(read.rows[1].line, 9U);
    EXPECT_EQ(read.rows[1].tuple.thetaI, 2);
}

TEST(ScatterRows, NoOffsetIsTheFarField) {
    EXPECT_FALSE(rowsOf(std::string(header) + "1,0,0,0, ,1.5,0.3,0.3,0,0\n").rows.at(0).tuple.h);
    EXPECT_EQ(rowsOf(std::string(header) + "1,0,0,0,0,1.5,0.3,0.3,0,0\n").rows.at(0).tuple.h, 0.0);
    const ScatterRows without = rowsOf(
        "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,eta,beta_m,beta_n,alpha_deg,sigma_a\n1,0,0,0,1.5,0.3,0.3,0,0\n");
    ASSERT_EQ(without.rows.size(), 1U);
    EXPECT_TRUE(without.rows[0].usable);
    EXPECT_FALSE(without.rows[0].tuple.h);
}

TEST(ScatterRows, LineEndsByteOrderMarkAndSpaces) {
    const std::string row = "1,0,0,0,0.5,1.5,0.3,0.3,0,0";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string head = header;
        head.pop_back();
        const ScatterRows read =
            rowsOf("\xef\xbb\xbf" + head + end + row + end + end + " 1 ,\t0 , 0,0,+0.5,1.5,3e-1,.3,-0, 0 " + end);
        ASSERT_EQ(read.rows.size(), 2U);
        EXPECT_TRUE(read.faults.empty());
        EXPECT_EQ(read.rows[1].line, 4U);
        EXPECT_EQ(read.rows[1].cells[1], "0");
        EXPECT_EQ(read.rows[1].tuple.betaM, 0.3);
        EXPECT_EQ(read.rows[1].tuple.h, 0.5);
    }
}

TEST(ScatterRows, BadCellsAreNamedByLineAndColumn) {
    const std::pair<const char*, const char*> bad[] = {
        {"x,0,0,0,0,1.5,0.3,0.3,0,0", "column 'theta_i_deg': found 'x', expected a number from -90 to 90"},
        {",0,0,0,0,1.5,0.3,0.3,0,0", "column 'theta_i_deg': found '', expected a number from -90 to 90"},
        {"90.1,0,0,0,0,1.5,0.3,0.3,0,0", "column 'theta_i_deg': found '90.1'"},
        {"0,nan,0,0,0,1.5,0.3,0.3,0,0", "column 'phi_i_deg': found 'nan'"},
        {"0,0,0,inf,0,1.5,0.3,0.3,0,0", "column 'phi_o_deg': found 'inf'"},
        {"0,0,-91,0,0,1.5,0.3,0.3,0,0", "column 'theta_o_deg': found '-91'"},
        {"0,0,0,0,1.01,1.5,0.3,0.3,0,0", "column 'h': found '1.01', expected a number from -1 to 1"},
        {"0,0,0,0,0,1,0.3,0.3,0,0", "column 'eta': found '1', expected a number from 1.0001 to 3"},
        {"0,0,0,0,0,1.5,0,0.3,0,0", "column 'beta_m': found '0'"},
        {"0,0,0,0,0,1.5,0.3,1.1,0,0", "column 'beta_n': found '1.1'"},
        {"0,0,0,0,0,1.5,0.3,0.3,29,0", "column 'alpha_deg': found '29'"},
        {"0,0,0,0,0,1.5,0.3,0.3,0,-1", "column 'sigma_a': found '-1'"},
        {"0,0,0,0,0,1.5,0.3,0.3,0,1e5", "column 'sigma_a': found '1e5'"},
        {"0,0,0,0,0,1.5,0.3,0.3,0,0x1", "column 'sigma_a': found '0x1'"},
        {"0,0,0,0,0,1.5,0.3,0.3,0,1e999", "column 'sigma_a': found '1e999'"},
        {"0,0,0,0,0,1.5", "too few cells: found 6, expected 10"},
        {"0,0,0,0,0,1.5,0.3,0.3,0,0,", "too many cells: found 11, expected 10"},
    };
    for (const auto& [row, what] : bad) {
        const ScatterRows read = rowsOf(std::string(header) + "# first\n" + row + "\n");
        ASSERT_EQ(read.rows.size(), 1U) << row;
        EXPECT_FALSE(read.rows[0].usable) << row;
        ASSERT_EQ(read.faults.size(), 1U) << row;
        EXPECT_EQ(read.faults[0].line, 3U);
        EXPECT_EQ(read.faults[0].text.rfind(what, 0), 0U) << read.faults[0].text;
    }
    EXPECT_EQ(rowsOf(std::string(header) + "x,0,0,0,y,1.5,0.3,0.3,0,z\n").faults.size(), 3U);
}

TEST(ScatterRows, FaultsOfTheWholeFile) {
    EXPECT_NE(refusalOf("").find("A091"), std::string::npos);
    EXPECT_NE(refusalOf("# only words\n").find("A091"), std::string::npos);
    EXPECT_NE(refusalOf("\xff\xfet\0h\0").find("UTF-16"), std::string::npos);
    const std::string missing =
        refusalOf("theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,eta,betam,beta_n,alpha_deg,sigma_a\n");
    EXPECT_NE(missing.find("t.csv:1:"), std::string::npos) << missing;
    EXPECT_NE(missing.find("A092"), std::string::npos) << missing;
    EXPECT_NE(missing.find("'beta_m'"), std::string::npos) << missing;
    EXPECT_NE(missing.find("is it 'betam'?"), std::string::npos) << missing;
    std::string twice = header;
    twice.insert(twice.size() - 1, ",h");
    EXPECT_NE(refusalOf(twice).find("A093"), std::string::npos);
    EXPECT_NE(refusalOf("1,2,3,4,5,6,7,8,9,10\n").find("A092"), std::string::npos);
}

TEST(ScatterRows, RowsKeepTheirOrderAndTheirText) {
    const ScatterRows read =
        rowsOf(std::string("# gone\n") + header +
               "1.50,0,0,0,,1.5,0.30,0.3,0,0\nbad,#1,0,0,0,1.5,0.3,0.3,0,0\n3,0,0,0,0,1.5,0.3,0.3,0,0\n");
    const std::vector<std::optional<app::RowLobes>> lobes{app::RowLobes{1, 2, 3, 4}, std::nullopt,
                                                          app::RowLobes{0.5, 0, 0, 1e-300}};
    const auto written = lines(writeScatterRows(read.rows, lobes, 17));
    ASSERT_EQ(written.size(), 4U);
    EXPECT_EQ(written[0] + "\n",
              std::string(header).insert(std::string(header).size() - 1, ",S_R,S_TT,S_TRT,S_RES,S_TOT"));
    EXPECT_EQ(written[1], "1.50,0,0,0,,1.5,0.30,0.3,0,0,1,2,3,4,10");
    EXPECT_EQ(written[2], "bad,?1,0,0,0,1.5,0.3,0.3,0,0,,,,,");
    EXPECT_EQ(written[3], "3,0,0,0,0,1.5,0.3,0.3,0,0,0.5,0,0,1e-300,0.5");
}

TEST(ScatterRows, SeventeenDigitsGiveADoubleBack) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> exponent(-300, 300);
    const ScatterRows read = rowsOf(std::string(header) + "1,0,0,0,,1.5,0.3,0.3,0,0\n");
    for (int i = 0; i < 200; ++i) {
        const double value = std::pow(10.0, exponent(random));
        const auto written =
            lines(writeScatterRows(read.rows, std::vector<std::optional<app::RowLobes>>{{{value, 0, 0, 0}}}, 17));
        const std::string& line = written.at(1);
        double found = 0;
        const char* first = line.data() + std::string("1,0,0,0,,1.5,0.3,0.3,0,0,").size();
        std::from_chars(first, line.data() + line.size(), found);
        EXPECT_EQ(found, value);
    }
}

class Scatter : public App {
protected:
    static std::string rows(const std::string& more = "") {
        return header + std::string("20,170,10,0,,1.55,0.3,0.3,-2,0.2\n20,170,10,0,0.3,1.55,0.3,0.3,-2,0.2\n") + more;
    }
};

TEST_F(Scatter, ExactRowsAndModels) {
    const std::string input = write("in.csv", rows());
    const RunResult exact = run({"scatter", "--exact", input});
    EXPECT_EQ(exact.exitCode, 0) << exact.err;
    EXPECT_EQ(exact.err, "");
    EXPECT_EQ(lines(exact.out).size(), 3U);
    for (const char* model : {"chiang", "moment_lut", "segment_cdf"}) {
        for (const char* precision : {"float", "double"}) {
            const RunResult result = run({"scatter", "--model", model, "--precision", precision, input});
            EXPECT_EQ(result.exitCode, 0) << result.err;
            EXPECT_EQ(lines(result.out).size(), 3U);
        }
    }
    EXPECT_EQ(run({"scatter", "--exact", input, "-o", path("out.csv")}).out, "");
    EXPECT_EQ(read(path("out.csv")), exact.out);
    // What was written is input again, with the same result.
    EXPECT_EQ(run({"scatter", "--exact", path("out.csv")}).out, exact.out);
}

TEST_F(Scatter, BadRowsAreNamedAndTheOthersEvaluated) {
    const std::string input = write("in.csv", rows("20,170,10,0,,x,0.3,0.3,-2,0.2\n0,0,0,0,,1.5,0.3,0.3,0,0\n"));
    const RunResult result = run({"scatter", "--exact", input});
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_EQ(result.err, input + ":4: column 'eta': found 'x', expected a number from 1.0001 to 3\n");
    const auto written = lines(result.out);
    ASSERT_EQ(written.size(), 5U);
    EXPECT_EQ(written[3], "20,170,10,0,,x,0.3,0.3,-2,0.2,,,,,");
    EXPECT_EQ(written[4].find(",,,,,"), std::string::npos);
}

TEST_F(Scatter, ShippedTuplesAreTheTruth) {
    const std::string shipped = std::string(PELAGE_SOURCE_DIR) + "/samples/scattering/tuples.csv";
    const RunResult result = run({"scatter", "--exact", shipped});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    // The last digits are those of a C library's exp and sin.
    const auto now = lines(result.out), then = lines(read(shipped));
    ASSERT_EQ(now.size(), then.size());
    for (std::size_t i = 1; i < now.size(); ++i) {
        const auto total = [](const std::string& line) {
            double value = -1;
            std::from_chars(line.data() + line.rfind(',') + 1, line.data() + line.size(), value);
            return value;
        };
        EXPECT_NEAR(total(now[i]), total(then[i]), 1e-9 * total(then[i]) + 1e-300) << "row " << i;
    }
}

TEST_F(Scatter, WhatCannotBeDone) {
    const std::string input = write("in.csv", rows());
    expectRefusal({"scatter", input}, "A095");
    expectRefusal({"scatter", "--exact", "--model", "chiang", input}, "A095");
    expectRefusal({"scatter", "--exact", "--precision", "float", input}, "A095");
    expectRefusal({"scatter", "--model", "phong", input}, "moment_lut");
    expectRefusal({"scatter", "--model", "chiang", "--precision", "half", input}, "A000");
    expectRefusal({"scatter", "--exact", path("nothing.csv")}, "A090");
    expectRefusal({"scatter", "--exact", write("empty.csv", "")}, "A091");
    expectRefusal({"scatter", "--exact", write("bad.csv", "a,b,c\n1,2,3\n")}, "A092");
    expectRefusal({"scatter", "--exact", input, "-o", path("no/out.csv")}, "A094");
    expectRefusal({"scatter", "--plot", path("a.jpg")}, "A096");
    expectRefusal({"scatter", "--plot", path("no/a.svg")}, "A094");
    expectRefusal({"scatter", "--plot", path("a.svg"), "--models", "phong"}, "phong");
}

TEST_F(Scatter, Plots) {
    EXPECT_EQ(run({"scatter", "--plot", path("a.svg"), "--models", "moment_lut"}).exitCode, 0);
    const std::string svg = read(path("a.svg"));
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_NE(svg.find("moment_lut"), std::string::npos);
    EXPECT_EQ(run({"scatter", "--plot", path("a.png"), "--model", "moment_lut", "--theta-o", "80"}).exitCode, 0);
    EXPECT_EQ(read(path("a.png")).substr(1, 3), "PNG");
}

}  // namespace

}  // namespace pelage::test

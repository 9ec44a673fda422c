// SPDX-License-Identifier: MIT
// Scattering rows as CSV: text to rows and back, without files. docs/scatter-csv.md is the format for its users.
// Faults are of two kinds: of the whole text (no header, a column missing), and of one row, which keeps its place in
// the output with empty values so that rows of two files stay side by side.
#pragma once

#include <pelage/base/diagnostic.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelage::app {

inline constexpr std::size_t scatterColumnCount = 10;
/// Input columns in the order in which they are written; they are read in any.
std::span<const std::string_view, scatterColumnCount> scatterColumns();

/// One configuration, in the units of the file.
struct ScatterTuple {
    double thetaI = 0, phiI = 0, thetaO = 0, phiO = 0;  // degrees
    std::optional<double> h = {};                       // absent: far field
    double eta = 1.55, betaM = 0.3, betaN = 0.3;
    double alpha = 0;   // degrees
    double sigmaA = 0;  // per fibre radius
};

struct ScatterRow {
    std::size_t line = 0;                                         // in the text read, from 1
    std::array<std::string_view, scatterColumnCount> cells = {};  // the user's text; empty where there is none
    ScatterTuple tuple = {};                                      // means something only where `usable`
    bool usable = false;
};

/// What is wrong in one row: "column 'eta': found 'x', expected a number from 1.0001 to 3".
struct RowFault {
    std::size_t line = 0;
    std::string text = {};
};

struct ScatterRows {
    std::vector<ScatterRow> rows = {};
    std::vector<RowFault> faults = {};  // in the order of their lines
};

/// Any bytes are accepted. Cells are views into `text`, which must outlive the rows. `name` is for the error.
pelage::Result<ScatterRows> readScatterRows(std::string_view text, const std::string& name);

/// S of R, TT, TRT, residual.
using RowLobes = std::array<double, 4>;

/// A header and the rows in their order, with their lobes and the sum of them, or empty values where there are none.
/// `digits`: significant ones, 17 to give a double back exactly, 9 for a float.
std::string writeScatterRows(std::span<const ScatterRow> rows, std::span<const std::optional<RowLobes>> lobes,
                             int digits);

}  // namespace pelage::app

// SPDX-License-Identifier: MIT
// Text tables with aligned columns, and small number formats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pelage::app {

class Table {
public:
    explicit Table(std::vector<std::string> heads) : rows_{std::move(heads)} {}
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    /// The first column to the left, the others to the right; each line ends in a line feed.
    std::string text() const;

private:
    std::vector<std::vector<std::string>> rows_;
};

std::string fixed(double value, int decimals);

}  // namespace pelage::app

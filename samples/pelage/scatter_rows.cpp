// SPDX-License-Identifier: MIT
#include "scatter_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pelage::app {

namespace {

enum Column : std::size_t { ThetaI, PhiI, ThetaO, PhiO, Offset, Eta, BetaM, BetaN, Alpha, SigmaA };

constexpr std::array<std::string_view, scatterColumnCount> names{
    "theta_i_deg", "phi_i_deg", "theta_o_deg", "phi_o_deg", "h", "eta", "beta_m", "beta_n", "alpha_deg", "sigma_a"};

struct Range {
    double low, high;
    const char* text;
};
constexpr std::array<Range, scatterColumnCount> ranges{{
    {-90, 90, "a number from -90 to 90"},
    {-1e9, 1e9, "a number from -1e9 to 1e9"},
    {-90, 90, "a number from -90 to 90"},
    {-1e9, 1e9, "a number from -1e9 to 1e9"},
    {-1, 1, "a number from -1 to 1, or nothing for the far field"},
    {1.0001, 3, "a number from 1.0001 to 3"},
    {1e-6, 1, "a number from 1e-6 to 1"},
    {1e-6, 1, "a number from 1e-6 to 1"},
    {-28.6, 28.6, "a number from -28.6 to 28.6"},
    {0, 1e4, "a number from 0 to 10000"},
}};

constexpr std::size_t notThere = static_cast<std::size_t>(-1);
/// Where each column stands in the file.
using Places = std::array<std::size_t, scatterColumnCount>;

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

void split(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    for (;;) {
        const std::size_t comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) return;
        line.remove_prefix(comma + 1);
    }
}

/// Takes the next line that says something off the front of a text. LF, CR LF and CR all end a line, so that no cell
/// ever has one inside.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    bool next(std::string_view& line) {
        while (!rest_.empty()) {
            const std::size_t end = rest_.find_first_of("\r\n");
            line = trimmed(rest_.substr(0, end));
            ++number_;
            if (end == std::string_view::npos) {
                rest_ = {};
            } else {
                rest_.remove_prefix(end + (rest_.substr(end, 2) == "\r\n" ? 2 : 1));
            }
            if (!line.empty() && line.front() != '#') return true;
        }
        return false;
    }
    std::size_t number() const { return number_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// Outside bytes inside a message: short, and nothing that a terminal takes for a command or a half letter.
std::string quoted(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string shown = "'";
    for (const char c : text.substr(0, longest)) shown += c < 0x20 || c > 0x7e ? '?' : c;
    return shown + (text.size() > longest ? "...'" : "'");
}

bool readNumber(std::string_view text, double& number) {
    // from_chars knows no plus sign; "+-1" must not become a number by that.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

Diagnostic fault(Code code, const std::string& name, std::size_t line, std::string text, std::string hint) {
    return {.code = code,
            .file = name,
            .line = static_cast<std::uint32_t>(std::min<std::size_t>(line, 0xffffffffU)),
            .column = line == 0 ? 0U : 1U,
            .text = std::move(text),
            .hint = std::move(hint)};
}

Result<Places> readHeader(const std::vector<std::string_view>& header, const std::string& name, std::size_t line) {
    Places places;
    for (std::size_t column = 0; column < names.size(); ++column) {
        const auto first = std::find(header.begin(), header.end(), names[column]);
        places[column] = first == header.end() ? notThere : static_cast<std::size_t>(first - header.begin());
        if (first != header.end() && std::find(first + 1, header.end(), names[column]) != header.end()) {
            return tl::unexpected(fault("A093", name, line,
                                        "the column '" + std::string(names[column]) + "' is there twice",
                                        "expected each input column once; rename or remove one"));
        }
        if (first != header.end() || column == Offset) continue;
        std::string hint = "the first line that is no comment names the columns, separated by commas";
        if (header.size() == 1 && header.front().find_first_of(";\t") != std::string_view::npos) {
            hint = "separate cells by commas";
        }
        std::vector<std::string> others;  // a misspelt name is not one of the other columns
        for (const std::string_view word : header) {
            if (std::find(names.begin(), names.end(), word) == names.end()) others.emplace_back(word);
        }
        if (const std::string_view near = nearestName(names[column], others); !near.empty()) {
            hint = "is it " + quoted(near) + "?";
        }
        return tl::unexpected(fault("A092", name, line,
                                    "there is no column '" + std::string(names[column]) + "', found " +
                                        quoted(header.front()) + " and " + std::to_string(header.size() - 1) + " more",
                                    hint));
    }
    return places;
}

/// Fills the row; gives what is wrong with it, which is nothing where the row is usable.
std::vector<std::string> readRow(const std::vector<std::string_view>& cells, const Places& places, ScatterRow& row) {
    std::vector<std::string> wrong;
    std::array<double, scatterColumnCount> value{};
    for (std::size_t column = 0; column < names.size(); ++column) {
        const std::size_t place = places[column];
        const std::string_view cell = place < cells.size() ? cells[place] : std::string_view();
        row.cells[column] = cell;
        if (place >= cells.size() || (column == Offset && cell.empty())) continue;
        const Range& range = ranges[column];
        double& x = value[column];
        if (!readNumber(cell, x) || x < range.low || x > range.high) {
            wrong.push_back("column '" + std::string(names[column]) + "': found " + quoted(cell) + ", expected " +
                            range.text);
        }
    }
    ScatterTuple& t = row.tuple;
    t = {value[ThetaI], value[PhiI],  value[ThetaO], value[PhiO],  {},
         value[Eta],    value[BetaM], value[BetaN],  value[Alpha], value[SigmaA]};
    if (!row.cells[Offset].empty()) t.h = value[Offset];
    return wrong;
}

/// A bad cell goes out again as it came, but never as something else: a comment, a line of its own, a byte of control.
void appendCell(std::string& text, std::string_view cell, bool usable) {
    if (usable) {
        text += cell;
        return;
    }
    for (const char c : cell) text += c == '#' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
}

void appendNumber(std::string& text, double number, int digits) {
    char room[64];
    const auto result = std::to_chars(room, room + sizeof room, number, std::chars_format::general, digits);
    text.append(room, result.ptr);
}

}  // namespace

std::span<const std::string_view, scatterColumnCount> scatterColumns() {
    return names;
}

pelage::Result<ScatterRows> readScatterRows(std::string_view text, const std::string& name) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
        return tl::unexpected(fault("A091", name, 1, "found UTF-16 text", "expected UTF-8; save it as such"));
    }
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    Lines lines(text);
    std::string_view line;
    if (!lines.next(line)) {
        return tl::unexpected(fault("A091", name, 0, "found no header and no rows",
                                    "expected a line that names the columns: theta_i_deg,phi_i_deg,..."));
    }
    std::vector<std::string_view> cells;
    split(line, cells);
    const auto places = readHeader(cells, name, lines.number());
    if (!places) return tl::unexpected(places.error());
    const std::size_t width = cells.size();
    ScatterRows result;
    while (lines.next(line)) {
        split(line, cells);
        ScatterRow row{.line = lines.number()};
        std::vector<std::string> wrong = readRow(cells, *places, row);
        if (cells.size() != width) {
            // With a cell too few or too many every value may stand in the wrong column: the count is what is wrong.
            wrong = {std::string(cells.size() < width ? "too few" : "too many") + " cells: found " +
                     std::to_string(cells.size()) + ", expected " + std::to_string(width) + " as in the header"};
        }
        row.usable = wrong.empty();
        for (std::string& what : wrong) result.faults.push_back({row.line, std::move(what)});
        result.rows.push_back(row);
    }
    return result;
}

std::string writeScatterRows(std::span<const ScatterRow> rows, std::span<const std::optional<RowLobes>> lobes,
                             int digits) {
    std::string text;
    for (const std::string_view name : names) text.append(name).append(",");
    text += "S_R,S_TT,S_TRT,S_RES,S_TOT\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const std::string_view cell : rows[i].cells) {
            appendCell(text, cell, rows[i].usable);
            text += ',';
        }
        if (i < lobes.size() && lobes[i]) {
            const RowLobes& s = *lobes[i];
            for (const double value : s) {
                appendNumber(text, value, digits);
                text += ',';
            }
            appendNumber(text, s[0] + s[1] + s[2] + s[3], digits);
        } else {
            text += ",,,,";
        }
        text += '\n';
    }
    return text;
}

}  // namespace pelage::app

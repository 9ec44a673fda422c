// SPDX-License-Identifier: MIT
// libFuzzer entry point of readScatterRows: no input may crash, and what is written for it is read again as the same
// rows, in which what was usable still is.
#include "scatter_rows.hpp"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pelage::app;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto read = readScatterRows(text, "fuzz");
    if (!read) {
        if (pelage::toString(read.error().first()).find('\n') != std::string::npos) std::abort();
        return 0;
    }
    for (const RowFault& fault : read->faults) {
        if (fault.text.find_first_of("\r\n") != std::string::npos) std::abort();
    }
    const std::vector<std::optional<RowLobes>> lobes(read->rows.size(), RowLobes{1e-300, 0, 0.1, 2});
    const std::string written = writeScatterRows(read->rows, lobes, 17);
    const auto again = readScatterRows(written, "again");
    if (!again || again->rows.size() != read->rows.size()) std::abort();
    for (std::size_t i = 0; i < read->rows.size(); ++i) {
        const ScatterRow &a = read->rows[i], &b = again->rows[i];
        if (a.usable && (!b.usable || a.cells != b.cells || a.tuple.h != b.tuple.h || a.tuple.eta != b.tuple.eta)) {
            std::abort();
        }
    }
    return 0;
}

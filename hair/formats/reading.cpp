// SPDX-License-Identifier: MIT
#include "reading.hpp"

namespace pelage::hair::reading {

std::string oneLine(std::string_view text, std::size_t limit) {
    std::string line;
    for (const char c : text) {
        const bool blank = static_cast<unsigned char>(c) <= 0x20 || c == 0x7F;
        if (blank && (line.empty() || line.back() == ' ')) continue;
        line += blank ? ' ' : c;
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.size() > limit) {
        line.resize(limit);
        line += "...";
    }
    return line;
}

Diagnostic remark(Severity severity, Code code, std::string_view file, std::string_view text, std::string_view hint) {
    Diagnostic d;
    d.severity = severity;
    d.code = code;
    d.file = file;
    d.text = oneLine(text, 600);
    d.hint = oneLine(hint, 600);
    return d;
}

tl::unexpected<Diagnostics> fault(Code code, std::string_view file, std::string_view text, std::string_view hint) {
    return tl::unexpected<Diagnostics>(remark(Severity::Error, code, file, text, hint));
}

tl::unexpected<Diagnostics> cannotRead(std::string_view file) {
    return fault("F001", file, "reading the file failed half way", "try again");
}

}  // namespace pelage::hair::reading

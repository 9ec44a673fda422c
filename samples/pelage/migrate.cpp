// SPDX-License-Identifier: MIT
// Rewrites material files of an older version of their type.
#include "commands.hpp"
#include "data.hpp"
#include "report.hpp"
#include "text_file.hpp"

#include <pelage/hair/library.hpp>
#include <pelage/materials/migrate.hpp>

#include <cstdio>

namespace pelage::app {

int migrate(const std::vector<std::string>& files) {
    hair::Library library(dataDirectory());
    int result = exitOk;
    for (const std::string& file : files) {
        auto text = readTextFile(file);
        if (!text) {
            result = report(text.error());
            continue;
        }
        const auto migrated = materials::migrate(*text, file, library.typesFor(file), library.parentSource());
        std::fputs((migrated ? migrated->notes : migrated.error()).text().c_str(), stderr);
        if (!migrated) {
            result = exitFailed;
            continue;
        }
        if (!migrated->isNeeded) {
            std::printf("%s: version %d already\n", file.c_str(), migrated->to);
            continue;
        }
        if (auto written = writeTextFile(file, migrated->text); !written) {
            result = report(written.error());
            continue;
        }
        std::printf("%s: version %d to %d; comments are not kept\n", file.c_str(), migrated->from, migrated->to);
    }
    return result;
}

}  // namespace pelage::app

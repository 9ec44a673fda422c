// SPDX-License-Identifier: MIT
// The readers of readers.def.
#pragma once

#include "source.hpp"

#include <pelage/hair/load.hpp>

namespace pelage::hair::reading {

/// Reads an asset of one format. Points are in the file's units; `notes` takes what the user should know.
#define PELAGE_READER(ending, function) \
    Result<Asset> function(Source& source, const std::string& name, Diagnostics& notes);
#include "readers.def"
#undef PELAGE_READER

/// For readers that give strands and nothing else: without the notes.
using Reader = Result<Asset>(Source& source, const std::string& name, Diagnostics& notes);
Result<Strands> strandsOnly(Reader& reader, Source source, const std::string& name);
Result<Strands> strandsOnly(Reader& reader, const std::string& path);

}  // namespace pelage::hair::reading

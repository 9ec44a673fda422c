// SPDX-License-Identifier: MIT
// libFuzzer entry: any bytes, first as a document, then as a schema for itself.
#include <pelage/base/json.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto document = pelage::json::parse(text, "fuzz");
    if (!document) {
        if (document.error().items().size() != 1 || document.error().items()[0].line == 0) std::abort();
        if (pelage::toString(document.error().items()[0]).find('\n') != std::string::npos) std::abort();
        return 0;
    }
    const auto schema = pelage::json::Schema::parse(text, "fuzz");
    if (schema) schema->validate(*document);
    return 0;
}

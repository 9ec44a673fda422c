// SPDX-License-Identifier: MIT
#include "support.hpp"

using namespace pelage;
using namespace pelage::materials;
using namespace pelage::materials::test;

TEST(DrawLists, ThoseTheTreeLacksAreNamedWithTheNearest) {
    const auto type = shipped("hair");
    EXPECT_TRUE(type->unknownDrawLists({"blend", "depth", "forward", "shadow", "other"}).empty());
    const Diagnostics found = type->unknownDrawLists({"blend", "depth", "forward", "shadows"});
    ASSERT_EQ(found.items().size(), 1U);
    const Diagnostic& only = found.items()[0];
    EXPECT_EQ(only.severity, Severity::Warning);
    EXPECT_EQ(only.code, Code("M017"));
    EXPECT_EQ(only.text, "shader 'shadow': the pass tree has no draw list 'shadow'; nothing draws it");
    EXPECT_EQ(only.hint, "did you mean 'shadows'?");
    // The place is that of the word in the file.
    std::istringstream lines(readFile(type->file()));
    std::string line;
    for (std::uint32_t i = 0; i < only.line; ++i) std::getline(lines, line);
    EXPECT_EQ(line.substr(only.column - 1, 8), "\"shadow\"");
    EXPECT_EQ(type->unknownDrawLists({}).items().size(), type->shaders().size());
}

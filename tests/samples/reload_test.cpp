// SPDX-License-Identifier: MIT
// Scripted edits of files on disk while a scene is shown: what is broken leaves the picture as it was and says why; the
// next good edit is taken at once. No window is needed.
#include "app_fixture.hpp"
#include "data.hpp"
#include "gpu.hpp"
#include "live_stage.hpp"

#include <algorithm>
#include <optional>

namespace pelage::test {

namespace {

namespace fs = std::filesystem;
using app::LiveStage;

class Reload : public App {
protected:
    void SetUp() override {
        App::SetUp();
        gpu_ = app::openGpu({.validation = true});
        ASSERT_TRUE(gpu_) << gpu_.error().first().line;
        const fs::path data = PELAGE_SOURCE_DIR;
        write("mine.pass.json", read((data / "hair/data/frames/hair_frame.pass.json").string()));
        write("hair.materialtype.json", read((data / "hair/data/types/hair.materialtype.json").string()));
        write("mine.material.json", material("[0.5, 0.3, 0.2]"));
        write("mine.scene.json", R"({ "format": "pelage.scene/1", "passTree": "./mine.pass.json",
            "objects": [{ "name": "hair", "generate": { "kind": "groom", "strands": 40 },
                          "material": "./mine.material.json" }],
            "lights": [{ "kind": "directional", "direction": [0, -1, -1] }] })");
    }
    void TearDown() override {
        live_.reset();
        if (gpu_) {
            EXPECT_EQ(app::finish(*gpu_), 0) << "the validation layer spoke";
        }
        App::TearDown();
    }

    static std::string material(const std::string& color) {
        return R"({ "format": "pelage.material/1", "type": "hair.materialtype.json", "typeVersion": 4,
                    "values": { "surface.baseColor": )" +
               color + " } }";
    }

    void open() {
        const app::StageOptions options{.input = path("mine.scene.json"), .size = "48x40"};
        hair::Library library(app::dataDirectory());
        auto stage = app::makeStage(options, library);
        ASSERT_TRUE(stage) << stage.error().first().line;
        const auto make = [this](const std::shared_ptr<const passes::PassTree>& tree) {
            return app::makeRenderer(*gpu_, tree, false);
        };
        auto renderer = make(stage->tree);
        ASSERT_TRUE(renderer) << renderer.error().first().line;
        live_.emplace(options, std::move(*stage), std::move(*renderer), make);
        last_ = picture();
        ASSERT_FALSE(last_.empty());
    }

    std::vector<std::uint8_t> picture() {
        auto drawn = live_->renderer().render(live_->stage().file.scene, live_->stage().file.frame);
        EXPECT_TRUE(drawn) << drawn.error().text();
        return drawn ? drawn->display : std::vector<std::uint8_t>();
    }

    /// `text` with the first `from` replaced.
    static std::string replaced(std::string text, const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return at == std::string::npos ? text : text.replace(at, from.size(), to);
    }
    void edit(const std::string& file, const std::string& from, const std::string& to) {
        write(file, replaced(read(path(file)), from, to));
    }

    /// One look at the files: the edit is not taken, for a reason that has `why` in it, and nothing of what is shown
    /// has changed.
    void expectKept(const std::string& why) {
        const LiveStage::Polled polled = live_->poll();
        ASSERT_EQ(polled.change, LiveStage::Change::Kept) << why;
        const std::string line = app::lineOf(polled.error);
        EXPECT_NE(line.find(why), std::string::npos) << line;
        ASSERT_EQ(polled.notes.items().size(), 1U);
        const std::string note = toString(polled.notes.items().front());
        EXPECT_EQ(note.rfind("note A130: keeping the version of ", 0), 0U) << note;
        EXPECT_EQ(note.size(), std::string("note A130: keeping the version of 12:04:31").size()) << note;
        EXPECT_EQ(live_->poll().change, LiveStage::Change::None) << "said once";
        EXPECT_EQ(picture(), last_);
    }
    /// One look: the edit is taken, and the picture is another.
    void expectTaken() {
        const LiveStage::Polled polled = live_->poll();
        ASSERT_EQ(polled.change, LiveStage::Change::Taken) << polled.error.text();
        const std::vector<std::uint8_t> now = picture();
        EXPECT_NE(now, last_);
        last_ = now;
        EXPECT_EQ(live_->poll().change, LiveStage::Change::None);
    }

    Result<app::Gpu> gpu_ = app::Gpu();
    std::optional<LiveStage> live_ = {};
    std::vector<std::uint8_t> last_ = {};
};

TEST_F(Reload, BrokenTreesAreNotTaken) {
    open();
    const std::string good = read(path("mine.pass.json"));
    const std::string other = replaced(good, R"("default": "aces")", R"("default": "none")");
    // Broken JSON, an unknown slot, and what only a device finds: a shader that there is not.
    write("mine.pass.json", good.substr(0, good.find("ForwardHair") + 4));  // ends inside a string
    expectKept("J008");
    write("mine.pass.json", replaced(good, "\"Resolve.color\"", "\"Resolve.colour\""));
    expectKept("did you mean 'color'?");
    write("mine.pass.json", replaced(good, "\"display.frag\"", "\"dispaly.frag\""));
    expectKept("dispaly.frag");
    write("mine.pass.json", other);
    expectTaken();
    write("mine.pass.json", good);
    expectTaken();
}

TEST_F(Reload, BrokenMaterialsAndTypesAreNotTaken) {
    open();
    write("mine.material.json", R"({ "format": "pelage.material/1", "type": "hair.materialtype.json",
                                     "typeVersion": 4, "values": 7 })");
    expectKept("J012");
    write("mine.material.json", material("[0.1, 0.5, 0.9]"));
    expectTaken();
    const std::string good = read(path("hair.materialtype.json"));
    write("hair.materialtype.json", replaced(good, "\"groups\"", "\"grups\""));
    expectKept("groups");
    write("hair.materialtype.json", good);
    const LiveStage::Polled back = live_->poll();
    EXPECT_EQ(back.change, LiveStage::Change::Taken) << back.error.text();
    EXPECT_EQ(picture(), last_) << "as it was";
}

TEST_F(Reload, ADeletedFileIsMissedOnlyWhenItStaysAway) {
    open();
    const std::string good = read(path("mine.material.json"));
    // As editors replace files: gone for one look, then there with other contents.
    fs::remove(path("mine.material.json"));
    EXPECT_EQ(live_->poll().change, LiveStage::Change::None);
    write("mine.material.json", material("[0.9, 0.1, 0.1]"));
    expectTaken();
    // Emptied, as a program does that is about to write.
    write("mine.material.json", "");
    EXPECT_EQ(live_->poll().change, LiveStage::Change::None);
    write("mine.material.json", material("[0.1, 0.9, 0.1]"));
    expectTaken();
    fs::remove(path("mine.material.json"));
    EXPECT_EQ(live_->poll().change, LiveStage::Change::None);
    expectKept("mine.material.json");
    write("mine.material.json", good);
    expectTaken();
}

TEST_F(Reload, TwoQuickEditsAndATouch) {
    open();
    // The same size, and the same time: only the contents tell.
    const auto time = fs::last_write_time(path("mine.material.json"));
    const auto paint = [&](const std::string& color) {
        write("mine.material.json", material(color));
        fs::last_write_time(path("mine.material.json"), time);
    };
    paint("[0.9, 0.3, 0.2]");
    paint("[0.1, 0.3, 0.2]");
    expectTaken();
    paint("[0.1, 0.3, 0.9]");
    expectTaken();
    fs::last_write_time(path("mine.material.json"), time + std::chrono::seconds(5));
    EXPECT_EQ(live_->poll().change, LiveStage::Change::None) << "only touched";
    // A broken edit and its repair within one look are not an event.
    const std::string good = read(path("mine.material.json"));
    write("mine.material.json", "{");
    write("mine.material.json", good);
    EXPECT_EQ(live_->poll().change, LiveStage::Change::None);
}

TEST_F(Reload, IncludedFilesAreWatched) {
    std::string tree = read(std::string(PELAGE_SOURCE_DIR) + "/hair/data/frames/hair_frame.pass.json");
    const std::size_t from = tree.find("\"displayTransform\": {"), to = tree.find('}', from) + 1;
    const std::string setting = tree.substr(from, to - from);
    tree.erase(tree.rfind(',', from), to - tree.rfind(',', from));
    write("mine.pass.json", replaced(tree, "\"name\": \"HairFrame\",",
                                     "\"name\": \"HairFrame\", \"include\": [\"parts/settings.pass.json\"],"));
    fs::create_directory(path("parts"));
    const std::string part = "{ \"format\": \"pelage.passtree/1\", \"settings\": { " + setting + " } }";
    write("parts/settings.pass.json", part);
    open();
    write("parts/settings.pass.json", replaced(part, "\"default\": \"aces\"", "\"default\": \"none\""));
    expectTaken();
    write("parts/settings.pass.json", replaced(part, "\"default\"", "\"defalt\""));
    expectKept("settings.pass.json");
    write("parts/settings.pass.json", part);
    expectTaken();
    // A file that the last good version did not have: the repair happens there, and is noticed.
    edit("mine.pass.json", "parts/settings.pass.json\"]", "parts/settings.pass.json\", \"more.pass.json\"]");
    expectKept("more.pass.json");
    write("more.pass.json", R"({ "format": "pelage.passtree/1", "drawLists": 3 })");
    expectKept("more.pass.json");
    write("more.pass.json", R"({ "format": "pelage.passtree/1", "drawLists": ["other"] })");
    const LiveStage::Polled polled = live_->poll();
    EXPECT_EQ(polled.change, LiveStage::Change::Taken) << polled.error.text();
}

}  // namespace

}  // namespace pelage::test

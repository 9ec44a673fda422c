// SPDX-License-Identifier: MIT
// host_engine: an engine of its own that has hair. See README.md.
#include "engine.hpp"
#include "hair.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wextra"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

int main(int count, char** words) {
    host::Options options;
    std::string out = "host_engine.png";
    bool hair = true;
    const char* data = std::getenv("PELAGE_DATA");
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto next = [&] { return i + 1 < count ? words[++i] : ""; };
        if (word == "--frames")
            options.frames = static_cast<std::uint32_t>(std::max(1, std::atoi(next())));
        else if (word == "--size")
            options.width = options.height = static_cast<std::uint32_t>(std::max(16, std::atoi(next())));
        else if (word == "--turn")
            options.turn = static_cast<float>(std::atof(next()));
        else if (word == "--conventional-depth")
            options.reversedDepth = false;
        else if (word == "--validate")
            options.validate = true;
        else if (word == "--adapter")
            options.adapter = next();
        else if (word == "--no-hair")
            hair = false;
        else if (word == "-o")
            out = next();
        else {
            std::fprintf(stderr,
                         "host_engine: error: unknown argument \"%s\"; there are --frames N, --size N, --turn RADIANS, "
                         "-o FILE.png, "
                         "--conventional-depth, --no-hair, --adapter NAME and --validate\n",
                         word.c_str());
            return 2;
        }
    }
    std::uint32_t messages = 0;
    {
        host::Engine engine(options, hair ? host::hairGuest(data != nullptr ? data : PELAGE_DATA_DIR) : host::Guest());
        const auto picture = engine.run();
        const int width = static_cast<int>(options.width), height = static_cast<int>(options.height);
        if (stbi_write_png(out.c_str(), width, height, 4, picture.data(), 4 * width) == 0) {
            std::fprintf(stderr, "host_engine: error: %s cannot be written\n", out.c_str());
            return 2;
        }
        std::printf("%s: %u frames, %llu submissions of the other thread between them\n", out.c_str(), options.frames,
                    static_cast<unsigned long long>(engine.streamed()));
        messages = engine.validationMessages();
    }
    if (messages != 0) std::fprintf(stderr, "host_engine: error: %u validation messages\n", messages);
    return messages == 0 ? 0 : 1;
}

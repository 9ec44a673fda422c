// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <pelage/materials/value.hpp>

#include <charconv>
#include <cmath>

namespace pelage::app {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t from = 0;
    for (;;) {
        const std::size_t to = text.find(separator, from);
        parts.push_back(text.substr(from, to == std::string::npos ? to : to - from));
        if (to == std::string::npos) return parts;
        from = to + 1;
    }
}

template <class Number>
bool parseNumber(const std::string& text, Number& number) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string::npos) return false;
    const auto [end, error] = std::from_chars(text.data() + first, text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

bool parseVector(const std::string& text, glm::vec3& vector) {
    const auto parts = split(text, ',');
    if (parts.size() != 3) return false;
    for (int i = 0; i < 3; ++i) {
        if (!parseNumber(parts[static_cast<std::size_t>(i)], vector[i]) || !std::isfinite(vector[i])) return false;
    }
    return true;
}

Failure wrong(const std::string& option, const std::string& text, const std::string& expected) {
    return Failure("A001: " + option + " is \"" + text + "\", expected " + expected);
}

}  // namespace

Result<Size> parseSize(const std::string& text) {
    const auto parts = split(text, 'x');
    Size size;
    if (parts.size() != 2 || !parseNumber(parts[0], size.width) || !parseNumber(parts[1], size.height) ||
        size.width == 0 || size.height == 0 || size.width > 16384 || size.height > 16384) {
        return tl::unexpected(wrong("--size", text, "WIDTHxHEIGHT with 1 to 16384 pixels each, for example 800x600"));
    }
    return size;
}

Result<hair::Camera> parseCamera(const std::string& text) {
    hair::Camera camera;
    const auto parts = split(text, ';');
    float degrees = glm::degrees(camera.verticalFov);
    const bool read = (parts.size() == 2 || parts.size() == 3) && parseVector(parts[0], camera.eye) &&
                      parseVector(parts[1], camera.target) && (parts.size() == 2 || parseNumber(parts[2], degrees));
    if (!read || !(degrees >= 1.0F && degrees <= 170.0F) || glm::distance(camera.eye, camera.target) < 1e-6F) {
        return tl::unexpected(wrong("--camera", text,
                                    "\"eyeX,eyeY,eyeZ;targetX,targetY,targetZ[;fov]\" in metres and degrees (1 to "
                                    "170), eye and target apart, for example \"0,1.6,1.2;0,1.6,0;26\""));
    }
    camera.verticalFov = glm::radians(degrees);
    return camera;
}

Result<glm::vec3> parseColor(const std::string& text, const std::string& option) {
    glm::vec3 color = {};
    if (text.size() == 7 && text[0] == '#') {
        bool read = true;
        for (int i = 0; i < 3; ++i) {
            const char* first = text.data() + 1 + 2 * i;
            unsigned value = 0;
            const auto [end, error] = std::from_chars(first, first + 2, value, 16);
            read = read && error == std::errc() && end == first + 2;
            color[i] = materials::srgbToLinear(static_cast<float>(value) / 255.0F);
        }
        if (read) return color;
    } else if (parseVector(text, color) && color.x >= 0 && color.y >= 0 && color.z >= 0) {
        return color;
    }
    return tl::unexpected(wrong(option, text, "\"r,g,b\" (scene-linear, not negative) or \"#rrggbb\" (sRGB)"));
}

Result<std::pair<std::string, std::string>> parseAssignment(const std::string& text, const std::string& option) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        return tl::unexpected(wrong(option, text, "NAME=VALUE"));
    }
    return std::pair(text.substr(0, equals), text.substr(equals + 1));
}

}  // namespace pelage::app

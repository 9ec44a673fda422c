// SPDX-License-Identifier: MIT
// A functor as a struct: its ports are members with names and types, made once when it is registered. A run reads and
// writes them through Call by index; it looks nothing up and allocates nothing of its own.
//
//     struct Falloff : Functor {
//         In<float> distance{this, "distance"};
//         Out<float> density{this, "density"};
//         void run(const Call& call) const { call.set(density, 1.0F / call[distance]); }
//     };
//     registry.add(functorType<Falloff>("Falloff", "What it is for."));
#pragma once

#include <pelage/materials/functor.hpp>

#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pelage::hair {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;
/// Types of ports whose values C++ holds in types that do not tell them.
struct Color;
struct Texture;

/// The words of an enum, each beside what it stands for.
template <class E>
using Words = std::vector<std::pair<std::string, E>>;

namespace detail {
template <class T>
inline constexpr materials::ValueType portType = materials::ValueType::Enum;
template <>
inline constexpr materials::ValueType portType<bool> = materials::ValueType::Bool;
template <>
inline constexpr materials::ValueType portType<int> = materials::ValueType::Int;
template <>
inline constexpr materials::ValueType portType<float> = materials::ValueType::Float;
template <>
inline constexpr materials::ValueType portType<Float3> = materials::ValueType::Float3;
template <>
inline constexpr materials::ValueType portType<Float4> = materials::ValueType::Float4;
template <>
inline constexpr materials::ValueType portType<Color> = materials::ValueType::Color;
template <>
inline constexpr materials::ValueType portType<Texture> = materials::ValueType::Texture2D;
}  // namespace detail

/// The ports of a functor in the order of the struct's members; base of every functor.
struct Functor {
    std::vector<materials::Port> in = {}, out = {};
};

namespace detail {
template <class T>
std::size_t addPort(std::vector<materials::Port>& ports, std::string name, std::vector<std::string> words = {}) {
    ports.push_back({std::move(name), materials::Port::Kind::Value, portType<T>, std::move(words), false});
    return ports.size() - 1;
}
// A word's index among a port's words is its enumerator's number.
template <class E>
std::vector<std::string> inOrder(const Words<E>& words) {
    std::vector<std::string> list(words.size());
    for (const auto& [word, value] : words) list.at(static_cast<std::size_t>(value)) = word;
    return list;
}
}  // namespace detail

/// T: bool, int, float, Float3, Float4, Color, Texture, or an enum, whose words come with it.
template <class T>
struct In {
    In(Functor* functor, std::string name) : index(detail::addPort<T>(functor->in, std::move(name))) {}
    In(Functor* functor, std::string name, const Words<T>& words) requires std::is_enum_v<T>
        : index(detail::addPort<T>(functor->in, std::move(name), detail::inOrder(words))) {}
    std::size_t index;
};
template <class T>
struct Out {
    using Type = T;
    Out(Functor* functor, std::string name) : index(detail::addPort<T>(functor->out, std::move(name))) {}
    Out(Functor* functor, std::string name, const Words<T>& words) requires std::is_enum_v<T>
        : index(detail::addPort<T>(functor->out, std::move(name), detail::inOrder(words))) {}
    std::size_t index;
};

/// The values of one run.
class Call {
public:
    Call(std::span<const materials::Value> in, materials::FunctorOutputs& out) : in_(in), out_(out) {}

    bool operator[](In<bool> port) const { return in_[port.index].integer != 0; }
    float operator[](In<float> port) const { return in_[port.index].number[0]; }
    /// The first three of four.
    const Float4& operator[](In<Float3> port) const { return in_[port.index].number; }
    /// Red, green, blue, 1.
    const Float4& operator[](In<Color> port) const { return in_[port.index].number; }
    /// A path or a built-in name.
    const std::string& operator[](In<Texture> port) const { return in_[port.index].text; }
    template <class E>
    requires std::is_enum_v<E> E operator[](In<E> port) const { return static_cast<E>(in_[port.index].integer); }

    void set(Out<bool> port, bool x) const { out_.set(port.index, materials::Value::boolean(x)); }
    void set(Out<float> port, float x) const { out_.set(port.index, materials::Value::scalar(x)); }
    void set(Out<Float3> port, const Float3& x) const {
        out_.set(port.index, materials::Value::float3(x[0], x[1], x[2]));
    }
    void set(Out<Float4> port, const Float4& x) const {
        out_.set(port.index, {materials::ValueType::Float4, x, 0, {}});
    }
    void set(Out<Color> port, const Float3& rgb) const {
        out_.set(port.index, materials::Value::color(rgb[0], rgb[1], rgb[2]));
    }
    void set(Out<Texture> port, std::string path) const {
        out_.set(port.index, materials::Value::texture(std::move(path)));
    }
    /// The output is the input as it came.
    template <class T>
    void pass(In<T> from, Out<T> to) const {
        out_.set(to.index, in_[from.index]);
    }

private:
    std::span<const materials::Value> in_;
    materials::FunctorOutputs& out_;
};

/// The functor F under the name by which material types call it.
template <class F>
materials::FunctorType functorType(std::string name, std::string description) {
    F functor;
    materials::FunctorType type{std::move(name), std::move(description), std::exchange(functor.in, {}),
                                std::exchange(functor.out, {})};
    type.run = [functor](std::span<const materials::Value> in, materials::FunctorOutputs& out) {
        functor.run(Call(in, out));
    };
    return type;
}

}  // namespace pelage::hair

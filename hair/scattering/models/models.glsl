// SPDX-License-Identifier: MIT
// Every model by its number, with one signature. In a shader `model` and `published` are specialization constants, so
// one branch is left of this.
#ifndef PELAGE_MODELS_GLSL
#define PELAGE_MODELS_GLSL
#include "fiber.glsl"
#include "scattering_model_files.glsl"  // generated from the list: the file of each model
#include "traits.glsl"

#define PELAGE_SCATTERING_MODEL(number, id, name, function, traits, title, source) const int MODEL_##id = number;
#include "include/pelage/hair/scattering_models.def"
#undef PELAGE_SCATTERING_MODEL

real3 finiteOrZero(real3 x) {
    real3 y;
    y.x = finiteOrZero(x.x);
    y.y = finiteOrZero(x.y);
    y.z = finiteOrZero(x.z);
    return y;
}

// As the model has it: for directions and materials that are numbers and in their ranges it is finite and not negative.
FiberLobes scatterFiberBare(int model, bool published, FiberAngles a, FiberMaterial m, FiberTable table) {
#define PELAGE_SCATTERING_MODEL(number, id, name, function, traits, title, source) \
    if (model == number) return function(a, m, table, published);
#include "include/pelage/hair/scattering_models.def"
#undef PELAGE_SCATTERING_MODEL
    return noLobes();
}

// The same, and zero where what came in was not a number.
FiberLobes scatterFiber(int model, bool published, FiberAngles a, FiberMaterial m, FiberTable table) {
    FiberLobes s = scatterFiberBare(model, published, a, m, table);
    s.R = finiteOrZero(s.R);
    s.TT = finiteOrZero(s.TT);
    s.TRT = finiteOrZero(s.TRT);
    s.RES = finiteOrZero(s.RES);
    return s;
}
#endif

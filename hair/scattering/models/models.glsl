// SPDX-License-Identifier: MIT
// Every model by its number, with one signature. In a shader `model` and `published` are specialization constants, so
// one branch is left of this.
#ifndef PELAGE_MODELS_GLSL
#define PELAGE_MODELS_GLSL
#include "chiang.glsl"
#include "gerard.glsl"
#include "kajiya_kay.glsl"
#include "karis.glsl"
#include "marschner.glsl"
#include "moments.glsl"
#include "pxr.glsl"
#include "scheuermann.glsl"
#include "segments.glsl"
#include "thesis.glsl"

const int MODEL_KAJIYA_KAY = 0;
const int MODEL_SCHEUERMANN = 1;
const int MODEL_MARSCHNER = 2;
const int MODEL_KARIS = 3;
const int MODEL_THESIS = 4;
const int MODEL_GERARD = 5;
const int MODEL_CHIANG = 6;
const int MODEL_PXR = 7;
const int MODEL_MOMENT_LUT = 8;
const int MODEL_SEGMENT_CDF = 9;

real3 finiteOrZero(real3 x) {
    real3 y;
    y.x = finiteOrZero(x.x);
    y.y = finiteOrZero(x.y);
    y.z = finiteOrZero(x.z);
    return y;
}

// As the model has it: for directions and materials that are numbers and in their ranges it is finite and not negative.
FiberLobes scatterFiberBare(int model, bool published, FiberAngles a, FiberMaterial m, FiberTable table) {
    if (model == MODEL_KAJIYA_KAY) return scatterKajiyaKay(a, m, table, published);
    if (model == MODEL_SCHEUERMANN) return scatterScheuermann(a, m, table, published);
    if (model == MODEL_MARSCHNER) return scatterMarschner(a, m, table, published);
    if (model == MODEL_KARIS) return scatterKaris(a, m, table, published);
    if (model == MODEL_THESIS) return scatterThesis(a, m, table, published);
    if (model == MODEL_GERARD) return scatterGerard(a, m, table, published);
    if (model == MODEL_CHIANG) return scatterChiang(a, m, table, published);
    if (model == MODEL_PXR) return scatterPxr(a, m, table, published);
    if (model == MODEL_MOMENT_LUT) return scatterMoments(a, m, table, published);
    if (model == MODEL_SEGMENT_CDF) return scatterSegments(a, m, table, published);
    return noLobes();
}

// The same, and zero where what came in was no number.
FiberLobes scatterFiber(int model, bool published, FiberAngles a, FiberMaterial m, FiberTable table) {
    FiberLobes s = scatterFiberBare(model, published, a, m, table);
    s.R = finiteOrZero(s.R);
    s.TT = finiteOrZero(s.TT);
    s.TRT = finiteOrZero(s.TRT);
    s.RES = finiteOrZero(s.RES);
    return s;
}
#endif

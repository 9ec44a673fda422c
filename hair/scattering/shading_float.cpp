// SPDX-License-Identifier: MIT
#define PELAGE_REAL float
#define PELAGE_SHADING shading_float
#define PELAGE_SCATTER scatterFloat
#include "shading.inl"

// SPDX-License-Identifier: MIT
#define PELAGE_REAL double
#define PELAGE_DOUBLE
#define PELAGE_SHADING shading_double
#define PELAGE_SCATTER scatterDouble
#include "shading.inl"

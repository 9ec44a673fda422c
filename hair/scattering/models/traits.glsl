// SPDX-License-Identifier: MIT
// What the renderer must know of a scattering model (scattering_models.def): bits, for GLSL and C++.
#ifndef PELAGE_TRAITS_GLSL
#define PELAGE_TRAITS_GLSL
const int TRAIT_CORRECTED = 1;    // the published form is wrong somewhere; `published` selects it
const int TRAIT_TABLE = 2;        // reads the moment table
const int TRAIT_OFFSET = 4;       // can be asked for one offset h
const int TRAIT_NEAR_FIELD = 8;   // rendered at one random offset per fragment: its mean over h costs too much
const int TRAIT_RECIPROCAL = 16;  // S / cos(theta_i) is the same with the two directions exchanged
const int TRAIT_CONTROLS = 32;    // widths, shifts and glint of the lobes are the artist's
#endif

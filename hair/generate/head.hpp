// SPDX-License-Identifier: MIT
// The mannequin as a signed distance: strands are combed around it, the mesh is polygonised from it.
#pragma once

#include <glm/glm.hpp>

namespace pelage::hair {

/// Metres to the surface, negative inside. Exact enough near the surface (gradient length within about 15 % of 1 within
/// a centimetre); far away it is only roughly a lower bound.
float headDistance(const glm::vec3& p);
/// Unit, away from the surface.
glm::vec3 headNormal(const glm::vec3& p);
/// `p`, moved out along the normal where it is closer than `margin` (m) to the surface or inside.
glm::vec3 keepOutside(glm::vec3 p, float margin);
/// `p`, moved along the normal to lie `height` (m) above the surface.
glm::vec3 toHeight(glm::vec3 p, float height);

/// Whether hair grows at this point of the surface: top, sides and back, neither face nor ears.
bool isScalp(const glm::vec3& p);

}  // namespace pelage::hair

# Sources of pelage_hair_geometry: readers and generators of hair. Needs pelage::json, tinygltf, glm and stb_image.h;
# no Vulkan, so that readers are tested and fuzzed without a device.
set(PELAGE_HAIR_GEOMETRY_SOURCES
  src/geometry/asset.cpp
  src/geometry/gltf.cpp
  src/geometry/gltf_accessor.cpp
  src/geometry/gltf_document.cpp
  src/geometry/groom_builder.cpp
  src/geometry/hair_file.cpp
  src/geometry/image.cpp
  src/geometry/islands.cpp
  src/geometry/lines.cpp
  src/geometry/reading.cpp
  src/geometry/tfx.cpp
  src/generate/card_atlas.cpp
  src/generate/card_frame.cpp
  src/generate/cards.cpp
  src/generate/clusters.cpp
  src/generate/follow.cpp
  src/generate/groom.cpp
  src/generate/guides.cpp
  src/generate/head.cpp
  src/generate/head_mesh.cpp
  src/generate/roots.cpp)

# What `cmake --install` gives: the libraries, their headers, the data files, the app where it was built, a CMake
# package (find_package(pelage COMPONENTS ...)) and a pkg-config file a library. Nothing installed holds a path of
# the build, so that the tree can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pelage)
set(data_dir ${CMAKE_INSTALL_DATADIR}/pelage)
set(generated ${CMAKE_CURRENT_BINARY_DIR}/package)

# pelage_install_library(NAME HEADERS dir): one component, which is one file of targets, so that a project that
# asks for rhi never needs what hair links. What a component needs stands in pelageConfig.cmake.in.
function(pelage_install_library name)
  cmake_parse_arguments(ARG "" "HEADERS" "" ${ARGN})
  install(TARGETS pelage_${name} EXPORT pelage-${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT pelage-${name} NAMESPACE pelage:: DESTINATION ${package_dir})
  if(ARG_HEADERS)
    install(DIRECTORY ${ARG_HEADERS}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
      FILES_MATCHING PATTERN "*.hpp" PATTERN "*.def")
  endif()
  set_property(GLOBAL APPEND PROPERTY PELAGE_COMPONENTS ${name})
endfunction()

# pelage_install_pkgconfig(NAME DESCRIPTION text LIBS names [REQUIRES modules] [REQUIRES_PRIVATE modules]
#                          [LIBS_PRIVATE flags] [INCLUDES dirs]): pelage-NAME.pc. INCLUDES are folders of headers that
# have no pkg-config file; those where the compiler looks anyway are left out.
function(pelage_install_pkgconfig name)
  cmake_parse_arguments(ARG "" "DESCRIPTION" "LIBS;REQUIRES;REQUIRES_PRIVATE;LIBS_PRIVATE;INCLUDES" ${ARGN})
  file(RELATIVE_PATH up /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
  string(REGEX REPLACE "/$" "" up "${up}")
  list(REMOVE_ITEM ARG_INCLUDES "" ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES})
  list(TRANSFORM ARG_INCLUDES PREPEND "-I")
  list(TRANSFORM ARG_LIBS PREPEND "-lpelage_")
  foreach(list LIBS REQUIRES REQUIRES_PRIVATE LIBS_PRIVATE INCLUDES)
    list(JOIN ARG_${list} " " ARG_${list})
  endforeach()
  configure_file(cmake/pelage.pc.in ${generated}/pelage-${name}.pc @ONLY)
  install(FILES ${generated}/pelage-${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

pelage_install_library(base HEADERS base)
pelage_install_library(rhi HEADERS rhi)
pelage_install_library(passes HEADERS passes)
pelage_install_library(materials HEADERS materials)
pelage_install_library(hair_geometry)
pelage_install_library(hair_formats)
pelage_install_library(hair_scattering)
pelage_install_library(hair HEADERS hair)

find_package(tl-expected REQUIRED)
get_target_property(expected_include tl::expected INTERFACE_INCLUDE_DIRECTORIES)
pelage_install_pkgconfig(base DESCRIPTION "The one error, its codes, and JSON with positions and schemas" LIBS base
  INCLUDES ${expected_include})
pelage_install_pkgconfig(rhi DESCRIPTION "Devices in WebGPU's shape over Vulkan 1.3" LIBS rhi REQUIRES pelage-base
  INCLUDES ${Vulkan_INCLUDE_DIR}
  LIBS_PRIVATE -lspirv-cross-core -ldl -pthread -Wl,--exclude-libs,libspirv-cross-core.a)
pelage_install_pkgconfig(passes DESCRIPTION "Pass trees: a frame as data" LIBS passes REQUIRES pelage-rhi pelage-base)
pelage_install_pkgconfig(materials DESCRIPTION "Material types, materials, functors" LIBS materials
  REQUIRES pelage-rhi pelage-base)
pelage_install_pkgconfig(hair DESCRIPTION "Hair: geometry, shading, renderer" LIBS hair hair_formats hair_geometry hair_scattering
  REQUIRES pelage-materials pelage-passes pelage-rhi pelage-base glm REQUIRES_PRIVATE tinygltf LIBS_PRIVATE -pthread)

if(TARGET pelage_reference)
  pelage_install_library(reference HEADERS hair/reference)
  pelage_install_pkgconfig(reference DESCRIPTION "Fibre scattering in double precision" LIBS reference)
endif()

# The data directory of hair::Library, with the schemas of all formats in one folder for editors.
# There "$schema" leads to that folder.
file(GLOB_RECURSE data_files RELATIVE ${PROJECT_SOURCE_DIR}/hair/data CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/hair/data/*.json)
foreach(file ${data_files})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS hair/data/${file})
  file(READ hair/data/${file} text)
  string(REGEX REPLACE "\\.\\./\\.\\./\\.\\./(passes|materials)/data/" "../schemas/" text "${text}")
  file(CONFIGURE OUTPUT ${generated}/data/${file} CONTENT "${text}" @ONLY)
endforeach()
install(DIRECTORY ${generated}/data/ DESTINATION ${data_dir})
install(DIRECTORY passes/data/ materials/data/ DESTINATION ${data_dir}/schemas)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET pelage)
  install(TARGETS pelage RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY samples/scenes DESTINATION ${data_dir})
endif()

get_property(components GLOBAL PROPERTY PELAGE_COMPONENTS)
configure_package_config_file(cmake/pelageConfig.cmake.in ${generated}/pelageConfig.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS data_dir)
write_basic_package_version_file(${generated}/pelageConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${generated}/pelageConfig.cmake ${generated}/pelageConfigVersion.cmake DESTINATION ${package_dir})

# pelage_library(NAME SOURCES... [PUBLIC targets...] [PRIVATE targets...])
# Makes the static library pelage_NAME with the alias pelage::NAME, its public headers under NAME/include.
function(pelage_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wno-missing-field-initializers
    -Wno-restrict  # gcc 12 warns of std::string concatenation itself (GCC bug 105651)
    $<$<BOOL:${PELAGE_WARNINGS_AS_ERRORS}>:-Werror>)
  if(PELAGE_SANITIZE)
    target_compile_options(${target} PUBLIC -fsanitize=${PELAGE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(${target} PUBLIC -fsanitize=${PELAGE_SANITIZE})
  endif()
endfunction()

function(pelage_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(pelage_${name} STATIC ${ARG_SOURCES})
  add_library(pelage::${name} ALIAS pelage_${name})
  set_target_properties(pelage_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(pelage_${name}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> PRIVATE src)
  target_link_libraries(pelage_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  pelage_compile_options(pelage_${name})
endfunction()

# Fails when a code of codes.def is raised nowhere, or when no test names it. A code that no test can provoke on a plain
# machine stands below with the reason.
cmake_policy(VERSION 3.22)
set(unprovoked
  A031   # needs a driver that breaks the rules
  A040   # needs an installation without scenes
  A060 A061 A062 A110   # need a broken build of the shaders, or a full disk
  A070 A080 A081 A082 A083   # need a display, or one without Vulkan
  A099   # by its meaning
  G013 T007 H007   # need files of a gigabyte
  T102   # every strand of the format has as many points as its header says
  T105   # the format has no widths
  R001   # needs a machine without the Vulkan loader
  X001)  # for a host's own code

file(STRINGS ${ROOT}/base/include/pelage/base/codes.def rows REGEX "^PELAGE_(RHI_)?CODE\\(")
function(texts out)
  set(all "")
  foreach(folder ${ARGN})
    file(GLOB_RECURSE files ${ROOT}/${folder}/*.cpp ${ROOT}/${folder}/*.hpp ${ROOT}/${folder}/*.inl ${ROOT}/${folder}/*.json)
    foreach(file ${files})
      file(READ ${file} text)
      string(APPEND all "${text}")
    endforeach()
  endforeach()
  set(${out} "${all}" PARENT_SCOPE)
endfunction()
texts(product base/src rhi/src passes/src passes/data materials/src materials/data hair samples)
texts(tests tests)

list(LENGTH rows count)
if(count LESS 200)
  message(SEND_ERROR "only ${count} codes were found: this test no longer sees the list")
endif()
foreach(row ${rows})
  string(REGEX MATCH "CODE\\(([A-Z][0-9]+), ?([A-Za-z]*)" ignored "${row}")
  set(code ${CMAKE_MATCH_1})
  set(name ${CMAKE_MATCH_2})
  string(SUBSTRING ${code} 0 1 family)
  string(SUBSTRING ${code} 1 3 number)
  set(raised FALSE)
  string(FIND "${product}" "\"${code}\"" at)
  if(NOT at EQUAL -1)
    set(raised TRUE)
  endif()
  # Readers of strands share the faults of one cleaner, which puts the letter of the format before the number.
  if(family MATCHES "[TH]")
    string(FIND "${product}" "\"${number}\"" at)
    if(NOT at EQUAL -1)
      set(raised TRUE)
    endif()
  endif()
  if(family STREQUAL R)
    string(FIND "${product}" "ErrorCode::${name}" at)
    if(NOT at EQUAL -1)
      set(raised TRUE)
    endif()
  endif()
  if(NOT raised AND NOT code STREQUAL X001)
    message(SEND_ERROR "${code} stands in codes.def and is raised nowhere")
  endif()
  if(family STREQUAL R OR code IN_LIST unprovoked)
    continue()  # rhi: tests/rhi/error_test.cpp provokes all of its own
  endif()
  string(FIND "${tests}" "${code}" at)
  if(at EQUAL -1)
    message(SEND_ERROR "${code} is provoked by no test")
  endif()
endforeach()

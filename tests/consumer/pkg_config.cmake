# cmake -DPREFIX=dir -DPKG_CONFIG=program -DCXX=compiler -DMODULE=name -DMAIN=file.cpp -DOUT=program -P pkg_config.cmake
# Compiles, links and runs MAIN as a makefile would: nothing but the compiler and what pkg-config says.
file(GLOB_RECURSE found ${PREFIX}/*/pelage-rhi.pc)
get_filename_component(folder "${found}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} "${folder}")
function(ask out)
  execute_process(COMMAND ${PKG_CONFIG} ${ARGN} ${MODULE} OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE
    COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(said UNIX_COMMAND "${said}")
  set(${out} ${said} PARENT_SCOPE)
endfunction()
ask(flags --cflags)
ask(libraries --static --libs)
ask(data --variable=datadir)
get_filename_component(directory ${OUT} DIRECTORY)
file(MAKE_DIRECTORY ${directory})
execute_process(COMMAND ${CXX} -std=c++20 -DCONSUMER_DATA_DIR="${data}" ${flags} ${MAIN} -o ${OUT} ${libraries}
  COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT} COMMAND_ERROR_IS_FATAL ANY)

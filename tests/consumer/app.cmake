# cmake -DPREFIX=dir -DSCENE=file -P app.cmake
# The installed app reads what lies in its own share/pelage: a material that is only there is found.
unset(ENV{PELAGE_DATA})
set(presets ${PREFIX}/share/pelage/presets)
file(COPY_FILE ${presets}/brown.material.json ${presets}/only_installed.material.json)
execute_process(COMMAND ${PREFIX}/bin/pelage check ${SCENE} COMMAND_ERROR_IS_FATAL ANY)

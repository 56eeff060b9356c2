# Installs BUILD under WORK, builds EXAMPLE against nothing else and lets it draw its picture. Run as:
# cmake -DBUILD=<tree> -DWORK=<scratch folder> -DEXAMPLE=<source> -DGENERATOR=<name> -P check.cmake
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV}: status ${status}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
set(prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_BUILD_TYPE=Release -DEXAMPLE=${EXAMPLE})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${CMAKE_COMMAND} -E env LYCHNITE_SHADER_DIR=${prefix}/share/lychnite/shaders ${WORK}/build/ten_lines)
run(${prefix}/bin/lychnite compare ${WORK}/marble.png ${WORK}/marble.png)
run(${prefix}/bin/lychnite render stone --size 10mm --resolution 32x32 -o stone.png)
file(REMOVE_RECURSE ${WORK})

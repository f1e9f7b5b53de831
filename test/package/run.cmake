# Installs the library to a folder of its own, then configures, builds and runs a project
# that finds it there.
#
#   cmake -DBUILD=<build tree> -DCONFIG=<configuration> -DWORK=<scratch> -P run.cmake

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --config ${CONFIG})

# A program may want no warnings of the headers, and it may be compiled for other vectors
# than the library, where g++ 12 has some of its own and of Eigen's to give.
set(programs "-Wall -Wextra -Werror")
file(READ /proc/cpuinfo processor)
if(processor MATCHES " avx2 ")
  list(APPEND programs -mavx2)
endif()
if(processor MATCHES " avx512f ")
  list(APPEND programs -march=native)
endif()
foreach(flags IN LISTS programs)
  string(MAKE_C_IDENTIFIER "build${flags}" name)
  set(build ${WORK}/${name})
  run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${build}
    -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=${CONFIG}
    -DCMAKE_CXX_FLAGS=${flags})
  run(${CMAKE_COMMAND} --build ${build} --config ${CONFIG})
  unset(consumer CACHE)
  find_program(consumer consumer
    PATHS ${build} ${build}/${CONFIG} NO_DEFAULT_PATH REQUIRED)
  run(${consumer})
endforeach()

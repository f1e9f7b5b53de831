# Installs the library to a folder of its own, which is then moved, and builds and runs a
# project that finds it there, by find_package() and by pkg-config. Removes it in the end.
#
#   cmake -DBUILD=<build tree> -DCONFIG=<configuration> -DWORK=<scratch> -P run.cmake
#     WITH_MANY_SCANS   whether the library for many scans is installed, too

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# Installing writes a list of files, of which the build tree may have one already that says
# what to remove from where it has been installed.
set(manifest ${BUILD}/install_manifest.txt)
if(EXISTS ${manifest})
  file(RENAME ${manifest} ${WORK}/before.txt)
endif()
execute_process(RESULT_VARIABLE result COMMAND
  ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/built --config ${CONFIG})
if(EXISTS ${manifest})
  file(RENAME ${manifest} ${WORK}/install_manifest.txt)
endif()
if(EXISTS ${WORK}/before.txt)
  file(RENAME ${WORK}/before.txt ${manifest})
endif()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "cmake --install failed")
endif()
file(RENAME ${WORK}/built ${WORK}/prefix)

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
  if(WITH_MANY_SCANS)
    unset(many_scans CACHE)
    find_program(many_scans many_scans
      PATHS ${build} ${build}/${CONFIG} NO_DEFAULT_PATH REQUIRED)
    run(${many_scans})
  endif()
endforeach()

find_program(pkg_config NAMES pkg-config pkgconf)
if(pkg_config)
  file(GLOB_RECURSE pc ${WORK}/prefix/*/pcl_kss_icp.pc)
  get_filename_component(folder ${pc} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  execute_process(COMMAND ${pkg_config} --cflags --libs --static pcl_kss_icp
    OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY OUTPUT_STRIP_TRAILING_WHITESPACE)
  get_filename_component(libraries ${folder} DIRECTORY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${CXX} -std=c++17 -O1 ${CMAKE_CURRENT_LIST_DIR}/consumer.cpp -o ${WORK}/consumer
    ${flags} -Wl,-rpath,${libraries})
  run(${WORK}/consumer)
endif()

file(RENAME ${WORK}/prefix ${WORK}/built)
run(${CMAKE_COMMAND} -DMANIFEST=${WORK}/install_manifest.txt
  -P ${CMAKE_CURRENT_LIST_DIR}/../../cmake/uninstall.cmake)
file(GLOB_RECURSE left LIST_DIRECTORIES true ${WORK}/built/*)
list(FILTER left EXCLUDE REGEX "/(bin|include|lib|lib/[^/]*|share|share/man)(/(cmake|pkgconfig|man1|licenses))?$")
if(left)
  message(FATAL_ERROR "left after the removal: ${left}")
endif()

# Run by cpack between staging and packing: adds what Debian wants in a package and no
# installation has, removes what it does not want, and finds out what packages need.
# What is set here of CPACK_DEBIAN_... counts in the packages.
#
# cpack's own search for shared libraries would add scripts that call ldconfig, where
# Debian has a trigger.

cmake_policy(VERSION 3.19)
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
set(scratch ${CPACK_TEMPORARY_DIRECTORY}/../debian_files)
set(version ${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
file(REMOVE_RECURSE ${scratch})

macro(run)
  execute_process(${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGN}")
  endif()
endmacro()

# The licence as Debian writes it: what is empty has a dot.
file(READ ${source}/LICENSE text)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]*)\n\n(.*)\n$" text "${text}")
set(holder "${CMAKE_MATCH_1}")
string(REPLACE "\n" "\n " text "${CMAKE_MATCH_2}")
string(REPLACE "\n \n" "\n .\n" text "${text}")
file(WRITE ${scratch}/copyright
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: pcl_kss_icp

Files: *
Copyright: ${holder}
License: BSD-3-clause
 ${text}
")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # SOURCE_DATE_EPOCH, if it is set
file(WRITE ${scratch}/changelog.Debian
"${CPACK_DEBIAN_PACKAGE_SOURCE} (${version}) unstable; urgency=medium

  * As the project's own packaging makes it; changelog.gz says what is new.

 -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${date}
")
configure_file(${source}/CHANGELOG.md ${scratch}/changelog COPYONLY)
run(COMMAND gzip -9 --no-name ${scratch}/changelog ${scratch}/changelog.Debian)

# What packages need of the libraries, and where dpkg-shlibdeps finds them.
file(WRITE ${scratch}/debian/control "")
set(library_folders "")
foreach(component library multiview)
  if(NOT component IN_LIST CPACK_COMPONENTS_ALL)
    continue()
  endif()
  string(TOUPPER ${component} id)
  set(package ${CPACK_DEBIAN_${id}_PACKAGE_NAME})
  string(REGEX MATCH "[0-9.]+$" soversion ${package})
  file(GLOB library
    ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/lib/*/libpcl_kss_icp*.so.${soversion})
  if(NOT library)
    message(FATAL_ERROR
      "A library is not in lib/<architecture>: configure with --fresh, or with another "
      "CMAKE_INSTALL_LIBDIR")
  endif()
  get_filename_component(folder ${library} DIRECTORY)
  list(APPEND library_folders -l${folder})
  get_filename_component(name ${library} NAME)
  string(REGEX REPLACE "\\.so\\..*" "" name ${name})
  file(WRITE ${scratch}/${component}/shlibs
    "${name} ${soversion} ${package} (>= ${CPACK_PACKAGE_VERSION})\n")
  file(READ ${scratch}/${component}/shlibs line)
  file(APPEND ${scratch}/debian/shlibs.local "${line}")
  set(CPACK_DEBIAN_${id}_PACKAGE_CONTROL_EXTRA
    ${CMAKE_CURRENT_LIST_DIR}/triggers ${scratch}/${component}/shlibs)
endforeach()

# Debian's own place for Python's packages, whichever one the build tree has.
file(GLOB python_packages
  ${CPACK_TEMPORARY_DIRECTORY}/python/usr/lib/python3.*/site-packages)
if(python_packages)
  file(MAKE_DIRECTORY ${CPACK_TEMPORARY_DIRECTORY}/python/usr/lib/python3)
  file(RENAME ${python_packages}
    ${CPACK_TEMPORARY_DIRECTORY}/python/usr/lib/python3/dist-packages)
  get_filename_component(folder ${python_packages} DIRECTORY)
  file(REMOVE_RECURSE ${folder})
endif()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} id)
  set(stage ${CPACK_TEMPORARY_DIRECTORY}/${component})
  file(COPY
    ${scratch}/copyright ${scratch}/changelog.gz ${scratch}/changelog.Debian.gz
    DESTINATION ${stage}/usr/share/doc/${CPACK_DEBIAN_${id}_PACKAGE_NAME}
    NO_SOURCE_PERMISSIONS)

  file(GLOB_RECURSE files ${stage}/*)
  set(programs "")
  foreach(file IN LISTS files)
    if(file MATCHES "/share/man/")
      run(COMMAND gzip -9 --no-name ${file})
    elseif(NOT IS_SYMLINK ${file})
      file(READ ${file} magic LIMIT 4 HEX)
      if(magic STREQUAL 7f454c46) # ELF
        run(COMMAND strip --strip-unneeded --remove-section=.comment ${file})
        file(RPATH_REMOVE FILE ${file}) # the loader finds all of it
        list(APPEND programs ${file})
        if(file MATCHES "\\.cpython-3([0-9]+)-") # for that version of Python alone
          math(EXPR next "${CMAKE_MATCH_1} + 1")
          list(APPEND CPACK_DEBIAN_${id}_PACKAGE_DEPENDS
            "python3 (>= 3.${CMAKE_MATCH_1}~), python3 (<< 3.${next})")
        endif()
      endif()
    endif()
  endforeach()
  if(programs)
    file(MAKE_DIRECTORY ${stage}/DEBIAN) # or dpkg-shlibdeps warns
    run(COMMAND dpkg-shlibdeps ${library_folders} -O ${programs}
      WORKING_DIRECTORY ${scratch} OUTPUT_VARIABLE needed)
    file(REMOVE_RECURSE ${stage}/DEBIAN)
    string(REGEX REPLACE "^shlibs:Depends=|\n" "" needed "${needed}")
    list(APPEND CPACK_DEBIAN_${id}_PACKAGE_DEPENDS "${needed}")
    list(JOIN CPACK_DEBIAN_${id}_PACKAGE_DEPENDS ", " CPACK_DEBIAN_${id}_PACKAGE_DEPENDS)
  endif()
endforeach()

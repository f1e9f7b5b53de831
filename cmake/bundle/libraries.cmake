# Run when the bundle is installed: copies the shared libraries that its programs need.
# The C library has to be the machine's own, and so have drivers, which nothing links to;
# the C++ library has to be whichever is newer, since drivers need theirs: it is put aside.

set(prefix $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX})
file(GLOB programs ${prefix}/bin/*)
file(GLOB own ${prefix}/lib/libpcl_kss_icp.so.*)
file(GET_RUNTIME_DEPENDENCIES
  EXECUTABLES ${programs}
  LIBRARIES ${own}
  DIRECTORIES ${prefix}/lib
  RESOLVED_DEPENDENCIES_VAR libraries
  UNRESOLVED_DEPENDENCIES_VAR missing
  CONFLICTING_DEPENDENCIES_PREFIX several
  PRE_EXCLUDE_REGEXES
    "^ld-linux" "^lib(c|m|mvec|dl|rt|pthread|resolv|util|anl|nsl)\\.so"
  POST_EXCLUDE_REGEXES "/libpcl_kss_icp\\.so")
if(missing)
  message(FATAL_ERROR "not found: ${missing}")
endif()
foreach(name IN LISTS several_FILENAMES)
  list(GET several_${name} 0 first)
  list(APPEND libraries ${first})
endforeach()
foreach(library IN LISTS libraries)
  set(folder lib)
  if(library MATCHES "/lib(stdc\\+\\+|gcc_s)\\.so")
    set(folder lib/fallback)
  endif()
  file(INSTALL ${library} DESTINATION ${CMAKE_INSTALL_PREFIX}/${folder} FOLLOW_SYMLINK_CHAIN)
endforeach()

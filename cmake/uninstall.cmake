# Removes what the last `cmake --install` has put somewhere, and the folders that are then
# empty and nobody else's: those of this name, and those of PCL's headers.
#
#   cmake -DMANIFEST=<build tree>/install_manifest.txt -P uninstall.cmake
# DESTDIR in the environment is heeded, as by the installation.

if(NOT EXISTS ${MANIFEST})
  message(FATAL_ERROR "Nothing has been installed: there is no ${MANIFEST}")
endif()
file(STRINGS ${MANIFEST} files)
set(folders "")
foreach(name IN LISTS files)
  set(file $ENV{DESTDIR}${name})
  if(EXISTS ${file} OR IS_SYMLINK ${file})
    message(STATUS "Removing ${file}")
    file(REMOVE ${file})
  endif()
  get_filename_component(folder ${file} DIRECTORY)
  while(folder MATCHES "/pcl_kss_icp(/|$)|/include/pcl(/|$)")
    list(APPEND folders ${folder})
    get_filename_component(folder ${folder} DIRECTORY)
  endwhile()
endforeach()

# what lies in a folder goes before it
list(REMOVE_DUPLICATES folders)
list(SORT folders ORDER DESCENDING)
foreach(folder IN LISTS folders)
  file(GLOB left ${folder}/* ${folder}/.*)
  if(IS_DIRECTORY ${folder} AND NOT left)
    file(REMOVE_RECURSE ${folder})
  endif()
endforeach()
file(REMOVE ${MANIFEST})

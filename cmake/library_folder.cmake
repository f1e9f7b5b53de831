# Before GNUInstallDirs: on Debian and what comes of it, libraries are installed to
# lib/<architecture> below any prefix, where the loader, pkg-config and CMake look for them
# below /usr and /usr/local. Packages for /usr are thus made of every build tree.
# -DCMAKE_INSTALL_LIBDIR=lib chooses otherwise.
if(CMAKE_LIBRARY_ARCHITECTURE AND EXISTS /etc/debian_version)
  set(CMAKE_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE}
    CACHE PATH "Folder of libraries, below the prefix")
endif()

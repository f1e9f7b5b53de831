# Debian packages, by `cpack -G DEB` in the build tree: one for each component that is
# installed. Included last, when all that is installed has been said.
#
# The Python package is made in a build tree of its own (PCL_KSS_ICP_BUILD_PYTHON): whatever
# is installed with COMPONENT python is in it.

get_cmake_property(components COMPONENTS)
if("Unspecified" IN_LIST components)
  message(FATAL_ERROR "An install() names no COMPONENT: see cmake/install.cmake")
endif()
if(NOT BUILD_SHARED_LIBS OR NOT EXISTS /etc/debian_version OR DEFINED SKBUILD)
  return()
endif()
set(packages "")
foreach(component library development multiview tool batch view python)
  if(component IN_LIST components)
    list(APPEND packages ${component})
  endif()
endforeach()

# cpack's own names
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL ${packages})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 0local1) # older than what Debian would make
set(CPACK_DEBIAN_PACKAGE_SOURCE pcl-kss-icp)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER
  "the pcl_kss_icp authors <pcl-kss-icp@example.org>"
  CACHE STRING "Who makes the Debian packages: Name <address>")
set(debian_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

# What is Debian's alone, such as its changelog, is put in when all has been staged.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/stage.cmake)

set(library_name libpcl-kss-icp${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(about
"It finds the rotation, translation and scale between two clouds of points,
complete or not, wherever they lie, by the method of KSS-ICP, with OpenCL
where there is a device.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library_name})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"registration of point clouds without a guess - shared library
pcl::KSSICP is a drop-in for IterativeClosestPoint of the Point Cloud
Library that needs no initial guess.

${about}")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpcl-kss-icp-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "${library_name} (= ${debian_version}), libpcl-dev, libeigen3-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"registration of point clouds without a guess - headers
What a program is built with that uses pcl::KSSICP: headers, and files for
find_package() and pkg-config.

${about}")

# A package of its own: the solver brings more along than the rest of the library.
set(multiview_name
  libpcl-kss-icp-multiview${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if("multiview" IN_LIST packages)
  string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    ", ${multiview_name} (= ${debian_version})")
endif()
set(CPACK_DEBIAN_MULTIVIEW_PACKAGE_NAME ${multiview_name})
set(CPACK_DEBIAN_MULTIVIEW_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_MULTIVIEW_DESCRIPTION
"registration of point clouds without a guess - many scans
pcl::registration::KSSMultiview finds the poses of many scans, without any to
begin with.

${about}")

set(CPACK_DEBIAN_TOOL_PACKAGE_NAME pcl-kss-icp)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOL_PACKAGE_SUGGESTS pcl-kss-icp-view)
set(CPACK_COMPONENT_TOOL_DESCRIPTION
"registration of point clouds without a guess - command line tool
pcl_kss_icp places one file upon another: clouds and meshes in PCD, PLY, OBJ,
STL, OFF and text.

${about}")

set(CPACK_DEBIAN_TOOL_PACKAGE_SUGGESTS pcl-kss-icp-view)

# A package of its own: Open MPI brings more along than all the rest of the tool.
set(CPACK_DEBIAN_BATCH_PACKAGE_NAME pcl-kss-icp-batch)
set(CPACK_DEBIAN_BATCH_PACKAGE_SECTION science)
set(CPACK_DEBIAN_BATCH_PACKAGE_SUGGESTS openmpi-bin)
set(CPACK_COMPONENT_BATCH_DESCRIPTION
"registration of point clouds without a guess - many pairs, many scans
pcl_kss_icp_batch registers the pairs of a list, and pcl_kss_icp_multiview
finds the poses of many scans: in threads or under mpirun, and they go on
where they were ended.

${about}")

set(CPACK_DEBIAN_VIEW_PACKAGE_NAME pcl-kss-icp-view)
set(CPACK_DEBIAN_VIEW_PACKAGE_SECTION science)
set(CPACK_COMPONENT_VIEW_DESCRIPTION
"registration of point clouds without a guess - viewer
The window in which pcl_kss_icp --view shows two clouds, one placed upon the
other. It needs much more than the rest, VTK before all.

${about}")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pcl-kss-icp)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS python3-numpy)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"registration of point clouds without a guess - Python module
pcl_kss_icp for Python registers clouds that are NumPy arrays.

${about}")

include(CPack)

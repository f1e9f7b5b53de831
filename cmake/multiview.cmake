# Many scans: a library of its own, as nothing else needs the solver.
find_package(Ceres 2.1 QUIET)
if(NOT Ceres_FOUND)
  message(STATUS "Ceres is not installed: there are no many scans")
  return()
endif()

add_library(pcl_kss_icp_multiview
  src/multiview/candidates_of_pairs.cpp
  src/multiview/connect_scans.cpp
  src/multiview/consensus.cpp
  src/multiview/pair_choice.cpp
  src/multiview/placement_of_scans.cpp
  src/multiview/pose_graph.cpp)
add_library(pcl_kss_icp::pcl_kss_icp_multiview ALIAS pcl_kss_icp_multiview)
target_compile_options(pcl_kss_icp_multiview PRIVATE -Wall -Wextra)
target_include_directories(pcl_kss_icp_multiview PRIVATE src)
target_link_libraries(pcl_kss_icp_multiview
  PUBLIC pcl_kss_icp
  PRIVATE Ceres::ceres)
set_target_properties(pcl_kss_icp_multiview PROPERTIES
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

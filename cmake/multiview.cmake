# Many scans: a library of its own, as nothing else needs the solver. It is made of what
# is installed of the other one.
find_package(Ceres 2.1 QUIET)
if(NOT Ceres_FOUND)
  message(STATUS "Ceres is not installed: the project goes without many scans")
  return()
endif()

# compiled once, for the library and for the tests, which look inside
add_library(pcl_kss_icp_multiview_objects OBJECT
  src/multiview/candidates_of_pairs.cpp
  src/multiview/connect_scans.cpp
  src/multiview/consensus.cpp
  src/multiview/joint_refinement.cpp
  src/multiview/pair_choice.cpp
  src/multiview/placed_scans.cpp
  src/multiview/placement_of_scans.cpp
  src/multiview/placing.cpp
  src/multiview/pose_graph.cpp
  src/multiview/verdicts.cpp)
target_compile_options(pcl_kss_icp_multiview_objects PRIVATE -Wall -Wextra)
target_include_directories(pcl_kss_icp_multiview_objects PRIVATE src)
target_link_libraries(pcl_kss_icp_multiview_objects
  PUBLIC pcl_kss_icp
  PRIVATE Ceres::ceres)
set_target_properties(pcl_kss_icp_multiview_objects PROPERTIES
  CXX_VISIBILITY_PRESET hidden
  VISIBILITY_INLINES_HIDDEN ON
  POSITION_INDEPENDENT_CODE ON)

add_library(pcl_kss_icp_multiview $<TARGET_OBJECTS:pcl_kss_icp_multiview_objects>)
add_library(pcl_kss_icp::pcl_kss_icp_multiview ALIAS pcl_kss_icp_multiview)
target_link_libraries(pcl_kss_icp_multiview
  PUBLIC pcl_kss_icp
  PRIVATE Ceres::ceres)
kss_icp_offer_only(pcl_kss_icp_multiview src/multiview/exports.map)
set_target_properties(pcl_kss_icp_multiview PROPERTIES
  LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

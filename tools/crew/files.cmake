# Those who do jobs that do not depend on each other: threads, and the ranks of MPI where
# there is MPI.
add_library(pcl_kss_icp_crew STATIC
  ${CMAKE_CURRENT_LIST_DIR}/processes_alone.cpp
  ${CMAKE_CURRENT_LIST_DIR}/thread_crew.cpp
  ${CMAKE_CURRENT_LIST_DIR}/workers.cpp)
target_compile_features(pcl_kss_icp_crew PUBLIC cxx_std_17)
target_compile_options(pcl_kss_icp_crew PRIVATE -Wall -Wextra)
target_include_directories(pcl_kss_icp_crew PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(pcl_kss_icp_crew PUBLIC Threads::Threads)

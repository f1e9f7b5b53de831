# Those who do jobs that do not depend on each other: threads, and the ranks of MPI where
# there is MPI.
set(PCL_KSS_ICP_WITH_MPI AUTO CACHE STRING
  "Have programs that do many jobs spread them over MPI's ranks: ON, OFF, or AUTO, where \
MPI and Boost.MPI are installed")
set_property(CACHE PCL_KSS_ICP_WITH_MPI PROPERTY STRINGS AUTO ON OFF)
set(with_mpi FALSE)
if(PCL_KSS_ICP_WITH_MPI)
  find_package(MPI QUIET COMPONENTS CXX)
  find_package(Boost 1.71 QUIET OPTIONAL_COMPONENTS mpi)
  if(MPI_CXX_FOUND AND TARGET Boost::mpi)
    set(with_mpi TRUE)
  elseif(PCL_KSS_ICP_WITH_MPI STREQUAL AUTO)
    message(STATUS "MPI or Boost.MPI is not installed: programs with many jobs go without")
  else()
    message(FATAL_ERROR "MPI or Boost.MPI is not installed (Debian: libopenmpi-dev, \
libboost-mpi-dev); -DPCL_KSS_ICP_WITH_MPI=OFF goes without")
  endif()
endif()

# for the tests
set(PCL_KSS_ICP_HAS_MPI ${with_mpi} CACHE INTERNAL "")

set(crew_dir ${CMAKE_CURRENT_LIST_DIR})
add_library(pcl_kss_icp_crew STATIC
  ${crew_dir}/thread_crew.cpp
  ${crew_dir}/workers.cpp)
target_compile_features(pcl_kss_icp_crew PUBLIC cxx_std_17)
target_compile_options(pcl_kss_icp_crew PRIVATE -Wall -Wextra)
target_include_directories(pcl_kss_icp_crew PUBLIC ${crew_dir}/..)
target_link_libraries(pcl_kss_icp_crew PUBLIC Threads::Threads)
if(with_mpi)
  target_sources(pcl_kss_icp_crew PRIVATE
    ${crew_dir}/mailbox.cpp
    ${crew_dir}/rank_crew.cpp
    ${crew_dir}/rank_service.cpp
    ${crew_dir}/processes_mpi.cpp)
  target_link_libraries(pcl_kss_icp_crew PRIVATE Boost::mpi MPI::MPI_CXX)
else()
  target_sources(pcl_kss_icp_crew PRIVATE ${crew_dir}/processes_alone.cpp)
endif()

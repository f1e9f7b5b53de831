# The tests of the command line tool.
#
#   ctest -L tool

if(NOT TARGET pcl_kss_icp_tool)
  return()
endif()
find_package(PCL 1.12 REQUIRED COMPONENTS common io)
find_package(nlohmann_json 3.9 REQUIRED)
find_package(Threads REQUIRED)

# What files hold, and how they are read and written.
add_executable(test_tool_files
  test_tool_files.cpp
  test_tool_hostile_files.cpp
  ${PROJECT_SOURCE_DIR}/tools/local_frame.cpp
  ${PROJECT_SOURCE_DIR}/tools/output_file.cpp
  ${PROJECT_SOURCE_DIR}/tools/signals.cpp)
target_compile_options(test_tool_files PRIVATE -Wall -Wextra)
target_link_libraries(test_tool_files
  PRIVATE pcl_kss_icp pcl_kss_icp_files pcl_io GTest::gtest_main)
add_test(NAME test_tool_files COMMAND test_tool_files)
set_tests_properties(test_tool_files PROPERTIES LABELS tool TIMEOUT 120)

# The tool itself: results, messages and exit codes.
add_executable(test_tool_run test_tool_run.cpp)
target_compile_features(test_tool_run PRIVATE cxx_std_17)
target_compile_options(test_tool_run PRIVATE -Wall -Wextra)
target_link_libraries(test_tool_run
  PRIVATE GTest::gtest Eigen3::Eigen nlohmann_json::nlohmann_json)
add_test(NAME test_tool_run COMMAND test_tool_run $<TARGET_FILE:pcl_kss_icp_tool>)
set_tests_properties(test_tool_run PROPERTIES LABELS tool TIMEOUT 300)

# The tool on inputs that are made to break it.
add_executable(test_tool_hostile test_tool_hostile.cpp)
target_compile_features(test_tool_hostile PRIVATE cxx_std_17)
target_compile_options(test_tool_hostile PRIVATE -Wall -Wextra)
target_link_libraries(test_tool_hostile PRIVATE GTest::gtest Threads::Threads)
add_test(NAME test_tool_hostile COMMAND test_tool_hostile
  $<TARGET_FILE:pcl_kss_icp_tool> --gtest_filter=-*DataForDevelopment)
set_tests_properties(test_tool_hostile PROPERTIES LABELS "tool;fast;long" TIMEOUT 300)
add_dependencies(fast_tests test_tool_hostile pcl_kss_icp_tool)
add_test(NAME test_tool_hostile_data COMMAND test_tool_hostile
  $<TARGET_FILE:pcl_kss_icp_tool> --gtest_filter=*DataForDevelopment)
set_tests_properties(test_tool_hostile_data PROPERTIES
  LABELS data TIMEOUT 600
  ENVIRONMENT PCL_KSS_ICP_TEST_DATA=${PCL_KSS_ICP_TEST_DATA}
  SKIP_REGULAR_EXPRESSION "Set PCL_KSS_ICP_TEST_DATA")

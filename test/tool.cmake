# The tests of the command line tool.
#
#   ctest -L tool

if(NOT TARGET pcl_kss_icp_tool)
  return()
endif()
find_package(PCL 1.12 REQUIRED COMPONENTS common io)
find_package(nlohmann_json 3.9 REQUIRED)

# What files hold, and how they are read and written.
add_executable(test_tool_files
  test_tool_files.cpp
  test_tool_hostile_files.cpp
  ${PROJECT_SOURCE_DIR}/tools/local_frame.cpp
  ${PROJECT_SOURCE_DIR}/tools/output_file.cpp
  ${PROJECT_SOURCE_DIR}/tools/signals.cpp)
target_compile_options(test_tool_files PRIVATE -Wall -Wextra)
target_link_libraries(test_tool_files
  PRIVATE pcl_kss_icp_files pcl_io GTest::gtest_main)
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

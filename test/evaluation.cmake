# The tests of the evaluation, benchmarks/evaluate.
#
#   ctest -L evaluation   runs the program on models of its own: most of a minute

find_package(nlohmann_json 3.9 REQUIRED)

# Cases, measures, processes, what is written, and the command line.
kss_icp_test(test_evaluation fast
  test_evaluation_random.cpp
  test_evaluation_cases.cpp
  test_evaluation_sources.cpp
  test_evaluation_metrics.cpp
  test_evaluation_processes.cpp
  test_evaluation_log.cpp
  test_evaluation_options.cpp)
target_link_libraries(test_evaluation PRIVATE pcl_kss_icp_evaluation)

# The program itself.
add_executable(test_evaluation_run test_evaluation_run.cpp)
target_compile_options(test_evaluation_run PRIVATE -Wall -Wextra)
target_link_libraries(test_evaluation_run
  PRIVATE pcl_kss_icp GTest::gtest nlohmann_json::nlohmann_json)
add_test(NAME test_evaluation_run
  COMMAND test_evaluation_run $<TARGET_FILE:pcl_kss_icp_evaluate>)
set_tests_properties(test_evaluation_run PROPERTIES LABELS evaluation TIMEOUT 300)
kss_icp_own_kernel_cache(test_evaluation_run)

# Tables, without what draws plots.
add_test(NAME test_evaluation_report COMMAND ${PCL_KSS_ICP_PYTHON}
  ${PROJECT_SOURCE_DIR}/benchmarks/evaluate/report/test_report.py)
set_tests_properties(test_evaluation_report PROPERTIES LABELS fast)

# The target bundle: pcl_kss_icp_bundle.tar.gz, which shows what the kernels do on another
# machine: one with the GPU in question, that need not have PCL, a compiler or root's
# permission. What is in it is installed as the component "bundle".

set(bundled
  pcl_kss_icp_tool
  pcl_kss_icp_benchmark
  test_evaluators
  test_opencl
  test_search
  test_several_devices)
foreach(program IN LISTS bundled)
  if(NOT TARGET ${program})
    return() # not all of the parts are built
  endif()
endforeach()

install(TARGETS ${bundled}
  RUNTIME DESTINATION bin COMPONENT bundle EXCLUDE_FROM_ALL)
if(BUILD_SHARED_LIBS)
  install(TARGETS pcl_kss_icp
    LIBRARY DESTINATION lib COMPONENT bundle NAMELINK_SKIP EXCLUDE_FROM_ALL)
endif()
install(PROGRAMS ${CMAKE_CURRENT_LIST_DIR}/run.sh
  DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/README.md ${CMAKE_CURRENT_LIST_DIR}/setup.sh
    LICENSE
  DESTINATION . COMPONENT bundle EXCLUDE_FROM_ALL)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/libraries.cmake
  COMPONENT bundle EXCLUDE_FROM_ALL)

set(bundle ${PROJECT_BINARY_DIR}/pcl_kss_icp_bundle)
add_custom_target(bundle
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${bundle}
  COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --config $<CONFIG>
    --component bundle --prefix ${bundle} --strip
  COMMAND ${CMAKE_COMMAND} -E tar czf pcl_kss_icp_bundle.tar.gz pcl_kss_icp_bundle
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR}
  VERBATIM)
add_dependencies(bundle ${bundled})

# What `cmake --install` puts where. Every install() of the project names a component, of
# which packages are made: library, development, multiview, tool, batch, view, python,
# licence; bundle is on its own (cmake/bundle/bundle.cmake).

include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pcl_kss_icp)

install(TARGETS pcl_kss_icp EXPORT pcl_kss_icpTargets
  RUNTIME COMPONENT library
  LIBRARY COMPONENT library NAMELINK_COMPONENT development
  ARCHIVE COMPONENT development)
if(TARGET pcl_kss_icp_multiview)
  install(TARGETS pcl_kss_icp_multiview EXPORT pcl_kss_icpTargets
    RUNTIME COMPONENT multiview
    LIBRARY COMPONENT multiview NAMELINK_COMPONENT development
    ARCHIVE COMPONENT development)
endif()
install(DIRECTORY include/pcl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development)
install(FILES ${export_header}
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pcl/registration/kss COMPONENT development)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/licenses/pcl_kss_icp
  COMPONENT licence)

# for find_package()
install(EXPORT pcl_kss_icpTargets NAMESPACE pcl_kss_icp:: DESTINATION ${package_folder}
  COMPONENT development)
configure_package_config_file(
  cmake/pcl_kss_icpConfig.cmake.in ${PROJECT_BINARY_DIR}/pcl_kss_icpConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/pcl_kss_icpConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/pcl_kss_icpConfig.cmake
  ${PROJECT_BINARY_DIR}/pcl_kss_icpConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)

# for pkg-config: where the file lies says where the rest is
set(pc_folder ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH prefix_from_pc ${pc_folder} ${CMAKE_INSTALL_PREFIX})
file(RELATIVE_PATH includes_from_pc ${pc_folder} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
set(pc_definitions -DPCL_KSS_ICP_COMPILED_ALIGNMENT=${PCL_KSS_ICP_ALIGNMENT})
if(NOT BUILD_SHARED_LIBS)
  string(APPEND pc_definitions " -DPCL_KSS_ICP_STATIC_DEFINE")
  set(pc_requires " OpenCL")
  set(pc_libraries " -pthread")
endif()
configure_file(cmake/pcl_kss_icp.pc.in ${PROJECT_BINARY_DIR}/pcl_kss_icp.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/pcl_kss_icp.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
    -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake
  VERBATIM)

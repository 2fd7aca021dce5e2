include(CMakePackageConfigHelpers)
get_property(WELKIN_ROOMS GLOBAL PROPERTY WELKIN_ROOMS)
install(TARGETS ${WELKIN_ROOMS} EXPORT welkinTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT welkinTargets NAMESPACE welkin:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
install(DIRECTORY welkin DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp" PATTERN "*.glsl" PATTERN "*.inc")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/welkin)
install(DIRECTORY presets DESTINATION ${CMAKE_INSTALL_DATADIR}/welkin FILES_MATCHING PATTERN "*.sky.toml")
configure_package_config_file(cmake/welkinConfig.cmake.in welkinConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
write_basic_package_version_file(welkinConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/welkinConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/welkinConfigVersion.cmake
              cmake/FindOpenVDB.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
if(TARGET welkin)
  install(TARGETS welkin RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

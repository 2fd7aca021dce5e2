# Every .glsl of the house becomes a string in the realtime library: no file is looked for at run time.
add_executable(welkin_embed_shaders ${PROJECT_SOURCE_DIR}/scripts/embed_shaders.cpp)
target_link_libraries(welkin_embed_shaders PRIVATE welkin_options)
file(GLOB_RECURSE WELKIN_GLSL CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/welkin/*.glsl)
set(EMBEDDED ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
list(TRANSFORM WELKIN_GLSL PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE WELKIN_GLSL_PATHS)
add_custom_command(OUTPUT ${EMBEDDED}
  COMMAND welkin_embed_shaders ${PROJECT_SOURCE_DIR} ${EMBEDDED} ${WELKIN_GLSL}
  DEPENDS welkin_embed_shaders ${WELKIN_GLSL_PATHS} VERBATIM)
target_sources(welkin_realtime PRIVATE ${EMBEDDED})
set_source_files_properties(${EMBEDDED} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

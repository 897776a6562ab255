# uchilsim_add_plugin(KIND FILE.cpp [VERSION v] [AUTHOR name] [LICENCE spdx])
#   makes the module plugins/KIND/FILE.so in the build folder (or below UCHILSIM_PLUGIN_OUTPUT), where KIND is
#   controllers, learners, fitness, effects or reality; the folder plugins/ is what UCHILSIM_PLUGINS takes. The target is
#   called plugin_KIND_FILE.
function(uchilsim_add_plugin kind source)
  cmake_parse_arguments(ABOUT "" "VERSION;AUTHOR;LICENCE" "" ${ARGN})
  set(kinds controllers learners fitness effects reality)
  if(NOT kind IN_LIST kinds)
    message(FATAL_ERROR "uchilsim_add_plugin: \"${kind}\" is not a kind of plugin; ${kinds}")
  endif()
  if(NOT UCHILSIM_PLUGIN_OUTPUT)
    set(UCHILSIM_PLUGIN_OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/plugins)
  endif()
  get_filename_component(name ${source} NAME_WE)
  set(target plugin_${kind}_${name})
  add_library(${target} MODULE ${source})
  target_link_libraries(${target} PRIVATE UCHILSIM::plugin)
  foreach(what VERSION AUTHOR LICENCE)
    if(ABOUT_${what})
      target_compile_definitions(${target} PRIVATE "BTR_PLUGIN_${what}=\"${ABOUT_${what}}\"")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name} SUFFIX .so CXX_EXTENSIONS OFF
    LIBRARY_OUTPUT_DIRECTORY ${UCHILSIM_PLUGIN_OUTPUT}/${kind})
endfunction()

# uchilsim_add_controller(FILE.cpp [VERSION v] [AUTHOR name] [LICENCE spdx])
#   of a behaviour (core/robot/robot.h) makes two things: the module plugins/controllers/FILE.so, as uchilsim_add_plugin
#   does, and the program programs/FILE (or below UCHILSIM_PROGRAM_OUTPUT), which moves a robot of a world that
#   `btr serve` runs. The program's target is called program_FILE.
function(uchilsim_add_controller source)
  uchilsim_add_plugin(controllers ${source} ${ARGN})
  if(NOT UCHILSIM_PROGRAM_OUTPUT)
    set(UCHILSIM_PROGRAM_OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/programs)
  endif()
  get_filename_component(name ${source} NAME_WE)
  add_executable(program_${name} ${source})
  target_compile_definitions(program_${name} PRIVATE UCHILSIM_PROGRAM)
  target_link_libraries(program_${name} PRIVATE UCHILSIM::plugin UCHILSIM::robot)
  set_target_properties(program_${name} PROPERTIES OUTPUT_NAME ${name} CXX_EXTENSIONS OFF
    RUNTIME_OUTPUT_DIRECTORY ${UCHILSIM_PROGRAM_OUTPUT})
endfunction()

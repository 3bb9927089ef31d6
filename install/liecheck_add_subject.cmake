# liecheck_add_subject(NAME SOURCES file... [LINK target...] [LIMITS file] [PROFILE ours|careful|half] [CASES n]
#                      [SEED n] [RULES version])
#
# Builds an adapter (docs/start.md) from the sources, and then adds a ctest test, with the label NAME, for each law of
# which the adapter offers an operation. The seed is fixed, so that a test that passed passes again. One more test,
# NAME.today, runs all laws with the date as its seed. With RULES, a later liecheck judges by the same laws, inputs, limits
# and hard cases (docs/ci.md).
function(liecheck_add_subject NAME)
  cmake_parse_arguments(PARSE_ARGV 1 a "" "LIMITS;PROFILE;CASES;SEED;RULES" "SOURCES;LINK")
  if(NOT a_SOURCES OR a_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "liecheck_add_subject(${NAME}): SOURCES is missing, or ${a_UNPARSED_ARGUMENTS} is unknown")
  endif()
  foreach(default "CASES 1000" "SEED 42")
    string(REPLACE " " ";" default ${default})
    list(GET default 0 name)
    if(NOT DEFINED a_${name})
      list(GET default 1 a_${name})
    endif()
  endforeach()
  set(target ${NAME}_liecheck_adapter)
  add_library(${target} MODULE ${a_SOURCES})
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_include_directories(${target} PRIVATE ${LIECHECK_ADAPTER_INCLUDE_DIR})
  target_link_libraries(${target} PRIVATE ${a_LINK})

  set(campaign ${LIECHECK_PROGRAM} campaign --adapter $<TARGET_FILE:${target}> --cases ${a_CASES})
  if(a_PROFILE)
    list(APPEND campaign --profile ${a_PROFILE})
  endif()
  if(a_LIMITS)
    get_filename_component(a_LIMITS ${a_LIMITS} ABSOLUTE)
    list(APPEND campaign --limits ${a_LIMITS})
  endif()
  set(rules "")
  if(a_RULES)
    set(rules --rules ${a_RULES})
    list(APPEND campaign ${rules})
  endif()
  # Which laws have an operation of the adapter is known when it is built. ctest includes the file that names them.
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${target}_tests.cmake)
  add_custom_command(
    TARGET ${target} POST_BUILD BYPRODUCTS ${tests} VERBATIM
    COMMAND ${CMAKE_COMMAND} -D NAME=${NAME} -D "LIST=${LIECHECK_PROGRAM};list;--laws;--adapter;$<TARGET_FILE:${target}>;${rules}"
            -D "CAMPAIGN=${campaign}" -D SEED=${a_SEED} -D TESTS=${tests} -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/liecheck_write_tests.cmake)
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake "if(EXISTS [==[${tests}]==])\n  include([==[${tests}]==])\nelse()\n"
                                     "  add_test(${NAME}_NOT_BUILT ${NAME}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
endfunction()

# cmake -D NAME=subject -D "LIST=command" -D "CAMPAIGN=command" -D SEED=n -D TESTS=file -P liecheck_write_tests.cmake
# Writes the tests of liecheck_add_subject(): a campaign for each law that the command LIST prints.
execute_process(COMMAND ${LIST} OUTPUT_VARIABLE laws COMMAND_ERROR_IS_FATAL ANY)
string(STRIP "${laws}" laws)
string(REPLACE "\n" ";" laws "${laws}")
set(campaign "")
foreach(word IN LISTS CAMPAIGN)
  string(APPEND campaign " [==[${word}]==]")
endforeach()
set(text "")
foreach(law IN LISTS laws)
  string(APPEND text "add_test([==[${NAME}.${law}]==]${campaign} --property ${law} --seed ${SEED})\n"
                     "set_tests_properties([==[${NAME}.${law}]==] PROPERTIES LABELS [==[${NAME}]==])\n")
endforeach()
file(WRITE ${TESTS} "${text}add_test([==[${NAME}.today]==] sh -c [==[exec \"$@\" --seed $(date +%Y%m%d)]==] today${campaign})\n"
                    "set_tests_properties([==[${NAME}.today]==] PROPERTIES LABELS [==[${NAME}]==])\n")

# What else a project can use of an installed liecheck.
find_package(liecheck 0.5 REQUIRED COMPONENTS laws)
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
add_executable(uses_lib uses_lib.cpp)
target_link_libraries(uses_lib PRIVATE liecheck::lib liecheck::batch)
target_compile_options(uses_lib PRIVATE -Wall -Wextra -Wshadow -Wconversion -Wpedantic -Werror)
add_test(NAME uses_lib COMMAND uses_lib)
# The laws in mylib's own test program; its flags do not reach liecheck's oracles.
add_executable(laws_test laws_test.cpp)
target_compile_options(laws_test PRIVATE -O1)
target_link_libraries(laws_test PRIVATE liecheck::laws GTest::gtest_main rapidcheck_gtest)

# cmake -DFILES=a;b -DOUTPUT=x.cpp -P embed.cmake
# Writes a C++ file with a raw string literal for each file, and embedded_file(name), which returns it.
set(text "#include <reports/record.hpp>\n#include <stdexcept>\n#include <string>\n\n")
string(APPEND text "namespace liecheck::reports {\n\nstd::string_view embedded_file(std::string_view name) {\n")
foreach(path IN LISTS FILES)
  get_filename_component(name ${path} NAME)
  file(READ ${path} content)
  string(APPEND text "  if (name == \"${name}\") return R\"liecheck(${content})liecheck\";\n")
endforeach()
string(APPEND text "  throw std::logic_error(\"no such embedded file: \" + std::string(name));\n}\n\n")
string(APPEND text "}  // namespace liecheck::reports\n")
file(WRITE ${OUTPUT} "${text}")

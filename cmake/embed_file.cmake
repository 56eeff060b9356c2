# Writes a C++ source that holds a file's bytes, so that nothing has to be found at run time. Run as:
# cmake -DINPUT=<file> -DOUTPUT=<source.cpp> -DNAME=<identifier> -P embed_file.cmake
# A string literal compiles many times faster than a list of numbers.
file(READ ${INPUT} hex HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" escaped "${hex}")
file(WRITE ${OUTPUT} "extern const char ${NAME}Bytes[];
const char ${NAME}Bytes[] = \"${escaped}\";
extern const unsigned long ${NAME}Size;
const unsigned long ${NAME}Size = sizeof ${NAME}Bytes - 1;
")

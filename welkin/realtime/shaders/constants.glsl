// Numbers that C++ has too; a test reads them from this text and compares.
const float PI = 3.14159265358979;

// Numbers that C++ has too; a test reads them from this text and compares.
const float PI = 3.14159265358979;
// Real spherical harmonics of degree 0 to 2: Y_00; y, z, x times SH_1; xy, yz, xz times SH_2; (3 z^2 - 1) times SH_20;
// (x^2 - y^2) times SH_22.
const float SH_0 = 0.28209479177388, SH_1 = 0.48860251190292, SH_2 = 1.09254843059208, SH_20 = 0.31539156525252, SH_22 = 0.54627421529604;
// What the clamped cosine multiplies the degrees 0, 1 and 2 by (Ramamoorthi & Hanrahan 2001, equation 8).
const float COSINE_0 = 3.14159265358979, COSINE_1 = 2.09439510239320, COSINE_2 = 0.78539816339745;

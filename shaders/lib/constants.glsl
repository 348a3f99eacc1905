// Numbers that more than one file needs.
const float PI = 3.14159265358979;
const float INV_PI = 0.318309886183791;

// The largest finite float32, for values whose truth overflows.
const float FLOAT_MAX = 3.402823e38;

// Least size of what rays divide by, where it may be 0: 0 times infinity, as for a ray within the
// very plane of a face, is no number.
const float SLIGHT = 1e-30;

// Lowest cosine that a model divides by: a float32 cosine of unit vectors is only good to 6e-8, so
// what is nearer to the horizon than this is rounding, not geometry.
const float GRAZING_COS = 1e-7;

// Lowest denominator of a visibility term: the product of two cosines of GRAZING_COS. It bites only
// nearer to the horizon than those, where both directions graze and the term is infinite.
const float VISIBILITY_FLOOR = 1e-14;

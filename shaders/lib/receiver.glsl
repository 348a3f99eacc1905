// A point that a light shines on: its position about the eye, its normal, the cosine of the light,
// and how far at most its triangle lies from the surface that it stands for, in metres.
struct Receiver {
    vec3 position;
    vec3 normal;
    float NoL;
    float gap;
};

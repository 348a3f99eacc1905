// A point that a light shines on: its position about the eye and its normal; how far at most its
// triangle lies from the surface that it stands for, in metres; the number of its object. Of the
// light: the direction to it, its distance, the cosine at the normal.
struct Receiver {
    vec3 position;
    vec3 normal;
    float gap;
    int object;
    vec3 toLight;
    float distance;
    float NoL;
};

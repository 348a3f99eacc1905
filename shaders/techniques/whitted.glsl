/*---
title    = "Ray tracing"
equation = '''
L = L_\mathrm{local} + \rho_r\, L(p, r) + \rho_t\, L(p, t),\quad r = d - 2 (d \cdot n)\, n,\quad
\sin\theta_t = \frac{\eta_1}{\eta_2} \sin\theta_i'''
source   = "Whitted 1980, An Improved Illumination Model for Shaded Display"
about    = """
A ray through each pixel's middle finds the nearest surface, which is shaded there; a mirror sends \
the ray on, and what lets light through sends it on bent. Local light is added in full, whatever \
their shares."""
surface  = ["mirror"]

[parameters.max_bounces]
kind    = "int"
default = 1
range   = [0, 16]
step    = 1
label   = "Bounces at most"

[parameters.min_energy]
kind    = "float"
default = 0.01
range   = [0.0, 1.0]
step    = 0.01
label   = "Least energy to follow"

[parameters.constants]
kind    = "bool"
default = true
label   = "Values compiled in (a change compiles anew)"
---*/
#include "stages/shaded.glsl"

uniform vec3 u_background;

#if BRANCHES
// A ray that waits: how much of what it brings arrives, how often it was sent on, what it leaves, and
// whether it only went through things: a mirror of nothing is black, a window shows the background.
struct Branch {
    Ray ray;
    float energy;
    int bounces;
    int from;
    bool through;
};

// Rays at most for a pixel, were there layer upon layer of what is half there.
const int MOST_RAYS = 1024;

vec3 trace(Ray ray) {
    vec3 sum = vec3(0.0);
    Branch waiting[MAX_BOUNCES + 2];
    waiting[0] = Branch(ray, 1.0, 0, NOTHING, true);
    int count = 1;
    for (int rays = 0; count > 0 && rays < MOST_RAYS; ++rays) {
        count -= 1;
        Branch b = waiting[count];
        Hit hit = nearest(b.ray, b.from);
        if (hit.object == NOTHING) {
            sum += b.through ? b.energy * u_background : vec3(0.0);
        } else {
            vec3 direction = b.ray.direction;
            met(hit, b.ray);
            vec4 light = shaded(hit);
            sum += b.energy * light.a * light.rgb;
#if BLENDED
            if (light.a < 1.0) {
                Ray on = leaving(hit.position, hit.normal, direction);
                waiting[count] = Branch(on, b.energy * (1.0 - light.a), b.bounces, hit.object, b.through);
                count += 1;
            }
#endif
            if (b.bounces < MAX_BOUNCES) {
#if REFLECTS
                float sentBack = b.energy * u_reflectance;
#else
                float sentBack = 0.0;
#endif
#if REFRACTS
                float sent = b.energy * u_transmittance;
                bool enters = dot(direction, hit.normal) < 0.0;
                vec3 n = enters ? hit.shading : -hit.shading;
                vec3 bent = refract(direction, n, enters ? 1.0 / u_refraction : u_refraction);
                if (dot(bent, bent) == 0.0) {
                    // Total internal reflection: all of it comes from the mirror's direction.
                    sentBack += sent;
                } else if (sent > u_min_energy) {
                    Ray on = leaving(hit.position, hit.normal, bent);
                    int left = enters ? within(hit.object) : hit.object;
                    waiting[count] = Branch(on, sent, b.bounces + 1, left, b.through);
                    count += 1;
                }
#endif
#if REFLECTS || REFRACTS
                if (sentBack > u_min_energy) {
                    Ray on = leaving(hit.position, hit.normal, mirrored(direction, hit.shading));
                    int left = dot(direction, hit.normal) < 0.0 ? hit.object : within(hit.object);
                    waiting[count] = Branch(on, sentBack, b.bounces + 1, left, false);
                    count += 1;
                }
#endif
            }
        }
    }
    return sum;
}
#elif REFLECTS
vec3 trace(Ray ray) {
    vec3 sum = vec3(0.0);
    float energy = 1.0;
    int from = NOTHING;
    for (int bounce = 0; bounce <= MAX_BOUNCES; ++bounce) {
        Hit hit = nearest(ray, from);
        if (hit.object == NOTHING) {
            // Only an eye's own ray shows the background: a mirror of nothing is black.
            return bounce == 0 ? u_background : sum;
        }
        met(hit, ray);
        sum += energy * shaded(hit).rgb;
        energy *= u_reflectance;
        if (energy <= u_min_energy) {
            return sum;
        }
#if TAKES_STEPS
        nextRight = mirrored(nextRight, hit.shading);
        nextUp = mirrored(nextUp, hit.shading);
#endif
        ray = leaving(hit.position, hit.normal, mirrored(ray.direction, hit.shading));
        from = hit.object;
    }
    return sum;
}
#else
vec3 trace(Ray ray) {
    Hit hit = nearest(ray, NOTHING);
    if (hit.object == NOTHING) {
        return u_background;
    }
    met(hit, ray);
    return shaded(hit).rgb;
}
#endif

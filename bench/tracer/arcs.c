/*
 * Ray paths through a layered atmosphere, nothing else: how fast plain C follows them on one core.
 *
 *     arcs PROFILE SLOPES RESULTS eye-height distance elevation segments repeats
 *
 * PROFILE holds doubles: height in m, temperature in degrees Celsius, and so on upward. SLOPES holds doubles: dz/dr of
 * each ray at the eye. RESULTS gets four doubles a ray: where it ended (r, z), its number of arcs, and why it ended
 * (0 below the lowest layer, 1 above the highest or the elevation, 2 at the distance, 3 at the number of arcs).
 * Prints one JSON object; its seconds are processor time, the least of all repeats.
 *
 * In a layer the temperature is linear and everything else is taken at its middle height, so that a ray has one
 * curvature there and is a parabola z = z0 + s x + a x^2:
 *     refractive index      n = 1 + e b p / T
 *     vertical gradient     dn/dz = -e b p (dT/dz + b g) / T^2      (hydrostatic: dp/dz = -g b p / T)
 *     a level ray           z'' = (dn/dz) / n + 1 / R               (the earth falls away under it)
 *                           a = z'' / 2
 */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const double e = 226e-6, b = 3.48e-3, g = 9.80665, sea_level = 101325.0, earth = 6371000.0;

struct layer {
    double bottom, top, a;
};

enum end { BELOW, ABOVE, DISTANCE, SEGMENTS };

struct result {
    double r, z, arcs, end;
};

static double *read_doubles(const char *path, long *count) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END)) exit(2);
    *count = ftell(file) / (long)sizeof(double);
    rewind(file);
    double *values = malloc(*count * sizeof *values);
    if (!values || fread(values, sizeof *values, *count, file) != (size_t)*count) exit(2);
    fclose(file);
    return values;
}

/* Pressure grows by this factor over a height in which the temperature runs linearly from t0 to t1, in K. */
static double pressure_factor(double t0, double t1, double height) {
    if (fabs(t1 - t0) < 1e-9) return exp(-b * g * height / t0);
    return pow(t1 / t0, -b * g * height / (t1 - t0));
}

static int make_layers(const double *profile, int points, double elevation, struct layer *layers) {
    int count = 0;
    double p = sea_level * pressure_factor(profile[1] + 273.15, profile[1] + 273.15, profile[0]);
    for (int i = 0; i + 1 < points; i++) {
        double z0 = profile[2 * i], z1 = profile[2 * i + 2];
        double t0 = profile[2 * i + 1] + 273.15, t1 = profile[2 * i + 3] + 273.15;
        double rate = (t1 - t0) / (z1 - z0), middle = 0.5 * (t0 + t1);
        double p_middle = p * pressure_factor(t0, middle, 0.5 * (z1 - z0));
        double n = 1.0 + e * b * p_middle / middle;
        double gradient = -e * b * p_middle * (rate + b * g) / (middle * middle);
        if (z0 < elevation) {
            double top = z1 < elevation ? z1 : elevation;
            layers[count++] = (struct layer){z0, top, 0.5 * (gradient / n + 1.0 / earth)};
        }
        p *= pressure_factor(t0, t1, z1 - z0);
    }
    return count;
}

static struct result follow(const struct layer *layers, int count, double z, double s, double distance, int segments) {
    int at = 0, arcs = 0;
    double r = 0.0;
    while (at + 1 < count && layers[at].top < z) at++;
    for (;;) {
        if (arcs == segments) return (struct result){r, z, arcs, SEGMENTS};
        arcs++;
        struct layer here = layers[at];
        int up = s > 0.0 || (s == 0.0 && here.a > 0.0);
        /* Mirrored, if need be, so that the ray sets out toward the boundary `ahead` and never back. */
        double ahead = up ? here.top - z : z - here.bottom;
        double behind = up ? z - here.bottom : here.top - z;
        double a = up ? here.a : -here.a, steep = fabs(s);
        double square = steep * steep + 4.0 * a * ahead, x;
        if (square >= 0.0) { /* it gets there */
            double root = sqrt(square);
            x = 2.0 * ahead / (steep + root);
            s = up ? root : -root;
        } else { /* it turns before, and leaves by the other boundary */
            double root = sqrt(steep * steep - 4.0 * a * behind);
            x = (steep + root) / (-2.0 * a);
            s = up ? -root : root;
            up = !up;
        }
        if (!(r + x < distance)) {
            double start = up == (square >= 0.0) ? steep : -steep, rest = distance - r;
            return (struct result){distance, z + (start + here.a * rest) * rest, arcs, DISTANCE};
        }
        r += x;
        z = up ? here.top : here.bottom;
        if (up ? ++at == count : at-- == 0) return (struct result){r, z, arcs, up ? ABOVE : BELOW};
    }
}

static double processor_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv) {
    if (argc != 9) return 2;
    long values, rays;
    double *profile = read_doubles(argv[1], &values), *slopes = read_doubles(argv[2], &rays);
    double eye = atof(argv[4]), distance = atof(argv[5]), elevation = atof(argv[6]);
    int segments = atoi(argv[7]), repeats = atoi(argv[8]);
    struct layer *layers = malloc((values / 2) * sizeof *layers);
    struct result *results = malloc(rays * sizeof *results);
    if (!layers || !results) return 2;
    int count = make_layers(profile, (int)(values / 2), elevation, layers);
    double best = INFINITY, arcs = 0.0;
    for (int k = 0; k < repeats; k++) {
        double started = processor_seconds();
        for (long i = 0; i < rays; i++) results[i] = follow(layers, count, eye, slopes[i], distance, segments);
        double seconds = processor_seconds() - started;
        if (seconds < best) best = seconds;
    }
    for (long i = 0; i < rays; i++) arcs += results[i].arcs;
    FILE *file = fopen(argv[3], "wb");
    if (!file || fwrite(results, sizeof *results, rays, file) != (size_t)rays || fclose(file)) return 2;
    printf("{\"seconds\": %.9f, \"paths\": %ld, \"arcs\": %.0f}\n", best, rays, arcs);
    return 0;
}

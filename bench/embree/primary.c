/*
 * The eye rays of a picture against a mesh and some spheres, one ray at a time, on one core, by Embree 3.
 *
 *     primary VERTICES FACETS SPHERES CAMERA width height repeats
 *
 * VERTICES: three doubles each. FACETS: three 32-bit numbers of vertices each. SPHERES: centre and radius, four doubles
 * each. CAMERA: twelve doubles, the eye, and then direction, right and up such that pixel (x, y) looks along
 * direction + (2 x / (width - 1) - 1) right + (1 - 2 y / (height - 1)) up.
 * Prints one JSON object; its seconds are processor time, the least of all repeats. Embree's rays and boxes are single
 * precision, and it uses the widest vectors of the processor.
 */
#define _POSIX_C_SOURCE 200809L
#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void *read_whole(const char *path, size_t item, size_t *count) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END)) exit(2);
    size_t bytes = (size_t)ftell(file);
    rewind(file);
    void *data = malloc(bytes ? bytes : 1);
    if (!data || fread(data, 1, bytes, file) != bytes) exit(2);
    fclose(file);
    *count = bytes / item;
    return data;
}

static double processor_seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void attach(RTCScene scene, RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

int main(int argc, char **argv) {
    if (argc != 8) return 2;
    size_t vertices, facets, spheres, twelve;
    double *positions = read_whole(argv[1], 3 * sizeof(double), &vertices);
    unsigned *corners = read_whole(argv[2], 3 * sizeof(unsigned), &facets);
    double *balls = read_whole(argv[3], 4 * sizeof(double), &spheres);
    double *camera = read_whole(argv[4], sizeof(double), &twelve);
    int width = atoi(argv[5]), height = atoi(argv[6]), repeats = atoi(argv[7]);
    if (twelve != 12) return 2;

    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    double started = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *v = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices);
    unsigned *f = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), facets);
    for (size_t i = 0; i < 3 * vertices; i++) v[i] = (float)positions[i];
    memcpy(f, corners, 3 * facets * sizeof(unsigned));
    attach(scene, mesh);
    if (spheres) {
        RTCGeometry points = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
        float *s = rtcSetNewGeometryBuffer(points, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), spheres);
        for (size_t i = 0; i < 4 * spheres; i++) s[i] = (float)balls[i];
        attach(scene, points);
    }
    rtcCommitScene(scene);
    double build = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - started;

    double best = INFINITY;
    long hits = 0;
    for (int k = 0; k < repeats; k++) {
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        hits = 0;
        started = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
        for (int y = 0; y < height; y++) {
            double up = 1.0 - 2.0 * y / (height - 1);
            for (int x = 0; x < width; x++) {
                double right = 2.0 * x / (width - 1) - 1.0, d[3];
                for (int i = 0; i < 3; i++) d[i] = camera[3 + i] + right * camera[6 + i] + up * camera[9 + i];
                double scale = 1.0 / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                struct RTCRayHit query = {0};
                query.ray.org_x = (float)camera[0];
                query.ray.org_y = (float)camera[1];
                query.ray.org_z = (float)camera[2];
                query.ray.dir_x = (float)(d[0] * scale);
                query.ray.dir_y = (float)(d[1] * scale);
                query.ray.dir_z = (float)(d[2] * scale);
                query.ray.tfar = INFINITY;
                query.ray.mask = ~0u;
                query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
                rtcIntersect1(scene, &context, &query);
                hits += query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
            }
        }
        double seconds = processor_seconds(CLOCK_THREAD_CPUTIME_ID) - started;
        if (seconds < best) best = seconds;
    }
    printf("{\"seconds\": %.9f, \"build\": %.9f, \"rays\": %d, \"hits\": %ld}\n", best, build, width * height, hits);
    return 0;
}

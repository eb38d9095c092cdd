/*
 * Box3D as a library that tunnelproof judges, in single precision. PEERS_METHOD chooses b3ShapeCast, preceded by
 * b3ShapeDistance, or b3TimeOfImpact. "Initially touching shapes are a miss" for the former, by its documentation: so it is
 * asked for the distance first, and a distance of 0 is a hit at the start.
 */
#include <string.h>

#include "../common/bodies.h"
#include "../common/timed.h"
#include "box3d/collision.h"
#include "tunnelproof_subject.h"

struct body {
    b3Vec3 points[8];
    int count;
    float radius;
    b3Sweep sweep;
};

static b3Vec3 vector(double x, double y, double z) {
    b3Vec3 v = {(float)x, (float)y, (float)z};
    return v;
}

/* Of a body whose points are where they are at the start. */
static b3Sweep translation(const double step[3]) {
    b3Sweep sweep = {{0, 0, 0}, {0, 0, 0}, vector(step[0], step[1], step[2]), {{0, 0, 0}, 1}, {{0, 0, 0}, 1}};
    return sweep;
}

/* Points relative to the origin, which is subtracted in double precision. */
static struct body body(const double points[24], int first, int count, double radius, const double origin[3]) {
    struct body body;
    double step[3];
    for (int i = 0; i < count; i++) {
        const double *p = points + 3 * (first + i);
        body.points[i] = vector(p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]);
    }
    body.count = count;
    if (count == 2 && memcmp(&body.points[0], &body.points[1], sizeof(b3Vec3)) == 0) body.count = 1;
    body.radius = (float)radius;
    peers_step(points, first, step);
    body.sweep = translation(step);
    return body;
}

static b3ShapeProxy proxy(const struct body *body) {
    b3ShapeProxy proxy = {body->points, body->count, body->radius};
    return proxy;
}

static int shape_cast(const struct body *a, const struct body *b, double *toi) {
    b3Vec3 first = a->sweep.c2, second = b->sweep.c2;
    b3Vec3 relative = {second.x - first.x, second.y - first.y, second.z - first.z};
    b3Transform identity = {{0, 0, 0}, {{0, 0, 0}, 1}};
    b3DistanceInput distance = {proxy(a), proxy(b), identity, true};
    b3ShapeCastPairInput input = {proxy(a), proxy(b), identity, relative, 1.0f, false};
    b3SimplexCache cache = {0};
    uint64_t start = peers_now();
    bool touches = b3ShapeDistance(&distance, &cache, NULL, 0).distance == 0;
    b3CastOutput output = {0};
    if (!touches) output = b3ShapeCast(&input);
    peers_took(start);
    *toi = touches ? 0 : output.fraction;
    return touches || output.hit ? TUNNELPROOF_HIT : TUNNELPROOF_MISS;
}

static int time_of_impact(const struct body *a, const struct body *b, double *toi) {
    b3TOIInput input = {proxy(a), proxy(b), a->sweep, b->sweep, 1.0f};
    uint64_t start = peers_now();
    b3TOIOutput output = b3TimeOfImpact(&input);
    peers_took(start);
    *toi = output.state == b3_toiStateOverlapped ? 0 : output.fraction;
    return output.state == b3_toiStateHit || output.state == b3_toiStateOverlapped ? TUNNELPROOF_HIT : TUNNELPROOF_MISS;
}

static bool is_time_of_impact(void) {
    const char *method = getenv("PEERS_METHOD");
    return method && !strcmp(method, "time-of-impact");
}

static int cast(const struct body *a, const struct body *b, double *toi) {
    return is_time_of_impact() ? time_of_impact(a, b, toi) : shape_cast(a, b, toi);
}

/* "The query is origin independent and runs in frame A": the frame of each query has its origin at A. */
int tunnelproof_edge_edge(const double points[24], const double radius[2], double *toi) {
    struct body a = body(points, 0, 2, radius[0] + peers_skin(), points), b = body(points, 2, 2, radius[1], points);
    return cast(&a, &b, toi);
}

int tunnelproof_vertex_face(const double points[24], const double radius[2], double *toi) {
    struct body a = body(points, 0, 1, radius[0] + radius[1] + peers_skin(), points), b = body(points, 1, 3, 0, points);
    return cast(&a, &b, toi);
}

/* A box is its corners, which are exact however it is turned. */
static struct body convex(const struct peers_body *from, const double origin[3]) {
    static const int counts[] = {1, 2, 3, 8};
    struct body body;
    body.count = counts[from->shape];
    for (int i = 0; i < body.count; i++) {
        double p[3];
        struct peers_body sharp = *from;
        sharp.radius = 0;
        if (from->shape == TUNNELPROOF_BOX) peers_corner(&sharp, i, p);
        else memcpy(p, from->points + 3 * i, sizeof p);
        body.points[i] = vector(p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]);
    }
    if (body.count == 2 && memcmp(&body.points[0], &body.points[1], sizeof(b3Vec3)) == 0) body.count = 1;
    body.radius = (float)from->radius;
    body.sweep = translation(from->step);
    return body;
}

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    struct peers_body both[2];
    peers_bodies(shapes, bodies, radius, both);
    struct body a = convex(&both[0], bodies), b = convex(&both[1], bodies);
    return cast(&a, &b, toi);
}

/* The origin of the frame is the centre of the first body at the start. */
static struct body turning(const struct peers_turning *from, const double origin[3]) {
    struct body body;
    double no_step[3] = {0, 0, 0};
    body.sweep = translation(no_step);
    for (int i = 0; i < from->count; i++)
        body.points[i] = vector(from->local[3 * i], from->local[3 * i + 1], from->local[3 * i + 2]);
    body.count = from->count;
    if (body.count == 2 && memcmp(&body.points[0], &body.points[1], sizeof(b3Vec3)) == 0) body.count = 1;
    body.radius = (float)from->radius;
    for (int end = 0; end < 2; end++) {
        const double *c = from->centres[end], *q = from->quaternions[end];
        *(end ? &body.sweep.c2 : &body.sweep.c1) = vector(c[0] - origin[0], c[1] - origin[1], c[2] - origin[2]);
        b3Quat rotation = {vector(q[0], q[1], q[2]), (float)q[3]};
        *(end ? &body.sweep.q2 : &body.sweep.q1) = rotation;
    }
    return body;
}

/* A shape cast does not turn. */
static int turning_cast(const double local[12], const double poses[28], int count, const double radius[2], double *toi) {
    struct peers_turning both[2];
    if (!is_time_of_impact()) return TUNNELPROOF_UNSUPPORTED;
    peers_turning(local, poses, count, radius, both);
    struct body a = turning(&both[0], poses), b = turning(&both[1], poses);
    return time_of_impact(&a, &b, toi);
}

int tunnelproof_turning_edge_turning_edge(const double local[12], const double poses[28], const double radius[2],
                                          double *toi) {
    return turning_cast(local, poses, 2, radius, toi);
}

int tunnelproof_turning_vertex_turning_face(const double local[12], const double poses[28], const double radius[2],
                                            double *toi) {
    return turning_cast(local, poses, 1, radius, toi);
}

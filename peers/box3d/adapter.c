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
    b3Vec3 step;
};

static b3Vec3 vector(double x, double y, double z) {
    b3Vec3 v = {(float)x, (float)y, (float)z};
    return v;
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
    body.step = vector(step[0], step[1], step[2]);
    return body;
}

static b3ShapeProxy proxy(const struct body *body) {
    b3ShapeProxy proxy = {body->points, body->count, body->radius};
    return proxy;
}

static int shape_cast(const struct body *a, const struct body *b, double *toi) {
    b3Vec3 relative = {b->step.x - a->step.x, b->step.y - a->step.y, b->step.z - a->step.z};
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

static b3Sweep sweep(const struct body *body) {
    b3Sweep sweep = {{0, 0, 0}, {0, 0, 0}, body->step, {{0, 0, 0}, 1}, {{0, 0, 0}, 1}};
    return sweep;
}

static int time_of_impact(const struct body *a, const struct body *b, double *toi) {
    b3TOIInput input = {proxy(a), proxy(b), sweep(a), sweep(b), 1.0f};
    uint64_t start = peers_now();
    b3TOIOutput output = b3TimeOfImpact(&input);
    peers_took(start);
    *toi = output.state == b3_toiStateOverlapped ? 0 : output.fraction;
    return output.state == b3_toiStateHit || output.state == b3_toiStateOverlapped ? TUNNELPROOF_HIT : TUNNELPROOF_MISS;
}

static int cast(const struct body *a, const struct body *b, double *toi) {
    const char *method = getenv("PEERS_METHOD");
    if (method && !strcmp(method, "time-of-impact")) return time_of_impact(a, b, toi);
    return shape_cast(a, b, toi);
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
    body.step = vector(from->step[0], from->step[1], from->step[2]);
    return body;
}

int tunnelproof_box_cast(const int shapes[2], const double bodies[30], const double radius[2], double *toi) {
    struct peers_body both[2];
    peers_bodies(shapes, bodies, radius, both);
    struct body a = convex(&both[0], bodies), b = convex(&both[1], bodies);
    return cast(&a, &b, toi);
}
